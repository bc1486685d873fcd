// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/generic_publisher.hpp"

#include <tracetools/tracetools.h>

#include "rclcpp/serialization.hpp"

namespace rclcpp {

void GenericPublisher::publish(const SerializedMessage& message) {
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, static_cast<const void*>(&message.get_rcl_serialized_message()));
  publish_serialized(message.get_rcl_serialized_message());
}

void GenericPublisher::publish_as_loaned_msg(const SerializedMessage& message) {
  void* const loan = borrow_memory(type_support_);
  if (!loan) {
    return;  // as a message that is published after shutdown
  }
  try {
    SerializationBase(type_support_).deserialize_message(&message, loan);
  } catch (...) {
    (void)rcl_return_loaned_message_from_publisher(get_publisher_handle().get(), loan);
    throw;
  }
  publish_loaned(loan);
}

}  // namespace rclcpp
