// SPDX-License-Identifier: Apache-2.0
// Messages of types that are known only at run time.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>

#include <memory>

namespace rclcpp::detail {

// A message with the defaults of its type. Throws exceptions::RCLError if the type support cannot make one.
std::shared_ptr<void> make_message(const rosidl_message_type_support_t& type_support);

}  // namespace rclcpp::detail
