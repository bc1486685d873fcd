// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/serialized_message.hpp"

#include <rmw/serialized_message.h>

#include <cstring>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

SerializedMessage::SerializedMessage(size_t initial_capacity, const rcl_allocator_t& allocator)
    : serialized_message_(rmw_get_zero_initialized_serialized_message()) {
  detail::require_ok(rmw_serialized_message_init(&serialized_message_, initial_capacity, &allocator),
                     "failed to allocate a serialized message");
}

SerializedMessage::SerializedMessage(const SerializedMessage& other) : SerializedMessage(other.serialized_message_) {}

SerializedMessage::SerializedMessage(SerializedMessage&& other) noexcept
    : SerializedMessage(std::move(other.serialized_message_)) {}

SerializedMessage::SerializedMessage(const rcl_serialized_message_t& other)
    : SerializedMessage(other.buffer_capacity, other.allocator) {
  if (other.buffer_length > 0) {
    std::memcpy(serialized_message_.buffer, other.buffer, other.buffer_length);
  }
  serialized_message_.buffer_length = other.buffer_length;
}

SerializedMessage::SerializedMessage(rcl_serialized_message_t&& other) noexcept
    : serialized_message_(std::exchange(other, rmw_get_zero_initialized_serialized_message())) {}

SerializedMessage& SerializedMessage::operator=(SerializedMessage other) noexcept {
  std::swap(serialized_message_, other.serialized_message_);
  return *this;
}

SerializedMessage::~SerializedMessage() {
  if (serialized_message_.buffer && rmw_serialized_message_fini(&serialized_message_) != RMW_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "failed to free a serialized message: %s", rcl_get_error_string().str);
    rcl_reset_error();
  }
}

void SerializedMessage::reserve(size_t capacity) {
  detail::require_ok(rmw_serialized_message_resize(&serialized_message_, capacity),
                     "failed to allocate a serialized message");
}

rcl_serialized_message_t SerializedMessage::release_rcl_serialized_message() {
  return std::exchange(serialized_message_, rmw_get_zero_initialized_serialized_message());
}

}  // namespace rclcpp
