// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/generic_publisher.hpp"

#include <tracetools/tracetools.h>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/serialization.hpp"

namespace rclcpp {

void GenericPublisher::publish(const SerializedMessage& message) {
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, static_cast<const void*>(&message.get_rcl_serialized_message()));
  publish_serialized(message.get_rcl_serialized_message());
}

void GenericPublisher::publish_as_loaned_msg(const SerializedMessage& message) {
  void* loan = nullptr;
  detail::require_ok(rcl_borrow_loaned_message(get_publisher_handle().get(), type_support_, &loan),
                     "failed to borrow a message");
  try {
    SerializationBase(type_support_).deserialize_message(&message, loan);
  } catch (...) {
    (void)rcl_return_loaned_message_from_publisher(get_publisher_handle().get(), loan);
    throw;
  }
  publish_loaned(loan);
}

}  // namespace rclcpp
