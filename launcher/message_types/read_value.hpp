// SPDX-License-Identifier: Apache-2.0
// Reads values of messages from YAML, as `ros2 topic pub` takes them: "{data: hello}".
//
// Fields that are not named keep their defaults. A number or word is a string where the field is one, exactly as it is
// written. `auto` for a std_msgs/Header, and `now` for a builtin_interfaces/Time, stand for the time of sending.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/message_types/interface_type.hpp"

namespace launch {

// A message, and where in it the times of sending go: the positions of members and elements from the outside in. Each
// place is that of a builtin_interfaces/Time.
struct MessageText {
  MessageValue value;
  std::vector<std::vector<std::size_t>> times;

  // Sets the times of sending. `nanoseconds` counts since 1970.
  void stamp(std::int64_t nanoseconds);
};

// Throws LaunchError with all mistakes, each at its place. An empty text is a message with defaults.
MessageText read_message(const MessageType& type, const LocatedText& yaml);

// A single field, without `auto` and `now`. Throws LaunchError.
MessageValue read_value(const FieldType& type, const LocatedText& yaml);

}  // namespace launch
