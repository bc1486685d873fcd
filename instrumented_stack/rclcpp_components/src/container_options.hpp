// SPDX-License-Identifier: Apache-2.0
// What the command line of a container asks for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rclcpp_components {

enum class ExecutorType { kSingleThreaded, kMultiThreaded, kEvents, kEventsCbg };

struct ContainerOptions {
  ExecutorType executor = ExecutorType::kSingleThreaded;
  bool is_isolated = false;  // each component has an executor of its own
  bool wants_help = false;
};

// `container` is the name of the program, which says what holds without options. `arguments` are those that are not
// for ROS, starting with the program. Throws std::invalid_argument for a wrong one.
ContainerOptions parse_container_options(std::string_view container, const std::vector<std::string>& arguments);

// How a container is called.
std::string container_usage(std::string_view container);

}  // namespace rclcpp_components
