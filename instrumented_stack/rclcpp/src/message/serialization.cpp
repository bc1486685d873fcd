// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/serialization.hpp"

#include <rmw/rmw.h>

#include <stdexcept>

#include "rclcpp/exceptions.hpp"

namespace rclcpp {

void SerializationBase::serialize_message(const void* ros_message, SerializedMessage* serialized_message) const {
  const rmw_ret_t ret = rmw_serialize(ros_message, type_support_, &serialized_message->get_rcl_serialized_message());
  if (ret != RMW_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "failed to serialize ROS message");
  }
}

void SerializationBase::deserialize_message(const SerializedMessage* serialized_message, void* ros_message) const {
  if (serialized_message->size() == 0) {
    throw std::runtime_error("failed to deserialize ROS message: the serialized message is empty");
  }
  const rmw_ret_t ret = rmw_deserialize(&serialized_message->get_rcl_serialized_message(), type_support_, ros_message);
  if (ret != RMW_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "failed to deserialize ROS message");
  }
}

}  // namespace rclcpp
