// SPDX-License-Identifier: Apache-2.0
// Writes values of messages as Python does, which is how `ros2 topic pub` and `ros2 service call` show them:
// "std_msgs.msg.String(data='hello')".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "launcher/message_types/interface_type.hpp"

namespace launch {

std::string to_python(const MessageType& type, const MessageValue& value);
std::string to_python(const FieldType& type, const MessageValue& value);

// 'it''s' -> "it's"
std::string python_string(std::string_view text);
// b'\x00\x01A'
std::string python_bytes(const std::uint8_t* bytes, std::size_t size);

}  // namespace launch
