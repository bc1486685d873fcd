// SPDX-License-Identifier: Apache-2.0
// The bytes of messages in tests: a payload without its encapsulation header, little-endian.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fastcdr_versions/cdr.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

template <typename Message>
const message_type_support_callbacks_t& callbacks() {
  const auto* handle = rosidl_typesupport_cpp::get_message_type_support_handle<Message>();
  return *static_cast<const message_type_support_callbacks_t*>(handle->data);
}

// The form in which bytes are compared, so that a failure is readable: "01 00 61".
inline std::string text_of(const char* bytes, std::size_t count) {
  constexpr char hex[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    text += i > 0 ? " " : "";
    text += {hex[byte >> 4], hex[byte & 15]};
  }
  return text;
}

// Reads "01 00  61" as three bytes; further spaces only help the reader.
inline std::vector<char> bytes_of(std::string_view text) {
  std::vector<char> bytes;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') {
      ++i;
      continue;
    }
    bytes.push_back(static_cast<char>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16)));
    i += 2;
  }
  return bytes;
}

// The bytes that cdr_serialize writes into a buffer of `capacity` bytes, as text; nothing if it refuses.
template <typename Message>
std::optional<std::string> serialized(const Message& message, std::size_t capacity) {
  std::vector<char> bytes(capacity + 1);
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), capacity);
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  if (!callbacks<Message>().cdr_serialize(&message, cdr)) {
    return std::nullopt;
  }
  return text_of(bytes.data(), fastcdr_versions::written_size(cdr));
}

// The same in a buffer of exactly the size that get_serialized_size returns.
template <typename Message>
std::string serialized(const Message& message) {
  return serialized(message, callbacks<Message>().get_serialized_size(&message)).value_or("does not fit");
}

// Whether cdr_deserialize accepts the bytes.
template <typename Message>
bool deserialize(std::vector<char> bytes, Message& message) {
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  return callbacks<Message>().cdr_deserialize(cdr, &message);
}
