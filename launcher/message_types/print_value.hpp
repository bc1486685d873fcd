// SPDX-License-Identifier: Apache-2.0
// Writes values of messages as YAML or CSV, as `ros2 topic echo` does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "launcher/message_types/interface_type.hpp"

namespace launch {

struct PrintStyle {
  static constexpr std::size_t kWhole = std::numeric_limits<std::size_t>::max();

  std::size_t truncate = kWhole;  // most elements of an array and characters of a string; "..." stands for the rest
  bool no_arrays = false;         // "<sequence type: float64, length: 3>" instead
  bool no_strings = false;        // "<string length: <5>>" instead
  bool flow = false;              // {data: 1} instead of lines
};

// With a line end. Texts are quoted as PyYAML quotes them.
std::string to_yaml(const FieldType& type, const MessageValue& value, const PrintStyle& style = {});

// All fields in order, separated by commas; without a line end. Texts are not quoted.
std::string to_csv(const FieldType& type, const MessageValue& value, const PrintStyle& style = {});

// A floating-point number as Python writes it: "1.0", "1e-07", "inf".
std::string python_float(double value);

// Writes values of messages as Python does, which is how `ros2 topic pub` and `ros2 service call` show them:
// "std_msgs.msg.String(data='hello')".
std::string to_python(const MessageType& type, const MessageValue& value);
std::string to_python(const FieldType& type, const MessageValue& value);

// 'it''s' -> "it's"
std::string python_string(std::string_view text);
// b'\x00\x01A'
std::string python_bytes(const std::uint8_t* bytes, std::size_t size);

}  // namespace launch
