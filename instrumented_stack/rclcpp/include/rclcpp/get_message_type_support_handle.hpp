// SPDX-License-Identifier: Apache-2.0
// The type support of a message type, or of the message type behind a TypeAdapter.
#pragma once

#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <stdexcept>

#include "rclcpp/type_adapter.hpp"

namespace rclcpp {

// Throws std::runtime_error if there is none.
template <typename MessageT>
const rosidl_message_type_support_t& get_message_type_support_handle() {
  const auto* handle =
      rosidl_typesupport_cpp::get_message_type_support_handle<typename TypeAdapter<MessageT>::ros_message_type>();
  if (handle == nullptr) {
    throw std::runtime_error("Type support handle unexpectedly nullptr");
  }
  return *handle;
}

}  // namespace rclcpp
