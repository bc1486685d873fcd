// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/message_memory.hpp"

#include <rmw/message_memory.h>

#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

std::shared_ptr<void> make_message(const rosidl_message_type_support_t& type_support) {
  void* message = rmw_create_message(&type_support);
  if (!message) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR, "could not create a message");
  }
  return {message, [&type_support](void* made) { rmw_destroy_message(&type_support, made); }};
}

}  // namespace rclcpp::detail
