// SPDX-License-Identifier: Apache-2.0
// Command lines, parsed by rcl and owned by C++ objects.
#pragma once

#include <rcl/arguments.h>

#include <string>
#include <vector>

namespace rclcpp::detail {

// The arguments after --ros-args that rcl did not recognise.
std::vector<std::string> unparsed_ros_arguments(const char* const* argv, const rcl_arguments_t& arguments);

// The arguments outside of `--ros-args … [--]`.
std::vector<std::string> without_ros_arguments(int argc, const char* const* argv);

// Parses `arguments` into `parsed`, which the caller finalizes. Throws exceptions::UnknownROSArgsError and
// exceptions::RCLInvalidROSArgsError.
void parse_arguments(const std::vector<std::string>& arguments, rcl_arguments_t& parsed);

}  // namespace rclcpp::detail
