// SPDX-License-Identifier: Apache-2.0
// A message as bytes: the 4-byte encapsulation header, then CDR. Owns its memory.
#pragma once

#include <rcl/allocator.h>
#include <rcl/types.h>

#include <cstddef>
#include <utility>

namespace rclcpp {

class SerializedMessage {
 public:
  SerializedMessage() : SerializedMessage(0) {}
  explicit SerializedMessage(size_t initial_capacity, const rcl_allocator_t& allocator = rcl_get_default_allocator());
  SerializedMessage(const SerializedMessage& other);
  SerializedMessage(SerializedMessage&& other) noexcept;
  explicit SerializedMessage(const rcl_serialized_message_t& other);
  // Takes ownership of the memory.
  explicit SerializedMessage(rcl_serialized_message_t&& other) noexcept;
  SerializedMessage& operator=(SerializedMessage other) noexcept;
  SerializedMessage& operator=(const rcl_serialized_message_t& other) { return *this = SerializedMessage(other); }
  SerializedMessage& operator=(rcl_serialized_message_t&& other) noexcept {
    return *this = SerializedMessage(std::move(other));
  }
  ~SerializedMessage();

  rcl_serialized_message_t& get_rcl_serialized_message() { return serialized_message_; }
  const rcl_serialized_message_t& get_rcl_serialized_message() const { return serialized_message_; }

  size_t size() const { return serialized_message_.buffer_length; }
  size_t capacity() const { return serialized_message_.buffer_capacity; }
  // Grows or shrinks the capacity; the bytes that fit are kept.
  void reserve(size_t capacity);
  // Passes the memory to the caller, who finalizes it.
  rcl_serialized_message_t release_rcl_serialized_message();

 private:
  rcl_serialized_message_t serialized_message_;
};

}  // namespace rclcpp
