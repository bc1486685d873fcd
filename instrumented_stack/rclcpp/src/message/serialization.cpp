// SPDX-License-Identifier: Apache-2.0
// Messages of which only the type support is known: their bytes and their memory.
#include "rclcpp/serialization.hpp"

#include <rmw/message_memory.h>
#include <rmw/rmw.h>

#include <stdexcept>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp {

void SerializationBase::serialize_message(const void* ros_message, SerializedMessage* serialized_message) const {
  detail::require_ok(rmw_serialize(ros_message, type_support_, &serialized_message->get_rcl_serialized_message()),
                     "failed to serialize ROS message");
}

void SerializationBase::deserialize_message(const SerializedMessage* serialized_message, void* ros_message) const {
  if (serialized_message->size() == 0) {
    throw std::runtime_error("failed to deserialize ROS message: the serialized message is empty");
  }
  detail::require_ok(rmw_deserialize(&serialized_message->get_rcl_serialized_message(), type_support_, ros_message),
                     "failed to deserialize ROS message");
}

std::shared_ptr<void> detail::make_message(const rosidl_message_type_support_t& type_support) {
  void* message = rmw_create_message(&type_support);
  if (!message) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR, "could not create a message");
  }
  return {message, [&type_support](void* made) { rmw_destroy_message(&type_support, made); }};
}

}  // namespace rclcpp
