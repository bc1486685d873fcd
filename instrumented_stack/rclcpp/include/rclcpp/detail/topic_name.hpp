// SPDX-License-Identifier: Apache-2.0
// Turns rcl's refusal of a topic or service name into the exception that shows where it is wrong.
#pragma once

#include <string>

namespace rclcpp::detail {

// Throws exceptions::InvalidTopicNameError if `name`, as written in the program, is malformed, else
// exceptions::RCLError with rcl's reason (a name can become wrong by expansion or remapping).
[[noreturn]] void throw_invalid_topic_name(const std::string& name);
// The same with exceptions::InvalidServiceNameError.
[[noreturn]] void throw_invalid_service_name(const std::string& name);

}  // namespace rclcpp::detail
