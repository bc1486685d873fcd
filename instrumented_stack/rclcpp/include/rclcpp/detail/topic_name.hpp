// SPDX-License-Identifier: Apache-2.0
// Turns rcl's error for a topic or service name into an exception that shows the wrong place in it.
#pragma once

#include <string>

namespace rclcpp::detail {

// Throws exceptions::InvalidTopicNameError if `name`, as written in the program, is malformed. Otherwise throws
// exceptions::RCLError with rcl's reason: expansion or remapping can make a name wrong.
[[noreturn]] void throw_invalid_topic_name(const std::string& name);
// Like throw_invalid_topic_name(), with exceptions::InvalidServiceNameError.
[[noreturn]] void throw_invalid_service_name(const std::string& name);

}  // namespace rclcpp::detail
