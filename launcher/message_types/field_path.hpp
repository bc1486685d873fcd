// SPDX-License-Identifier: Apache-2.0
// Chooses a part of a message by the names of fields: "pose.pose.position", "covariance[3]".
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/message_types/interface_type.hpp"

namespace launch {

class FieldPath {
 public:
  // The whole message.
  explicit FieldPath(std::shared_ptr<const MessageType> message);
  // Throws LaunchError at the part of the text that does not exist. Parts are separated by points, as `ros2` does; an
  // index in brackets chooses an element.
  FieldPath(std::shared_ptr<const MessageType> message, const LocatedText& path);

  const FieldType& type() const { return type_; }
  // Null if a sequence of the message is too short.
  const MessageValue* find(const MessageValue& message) const;

 private:
  FieldType type_;
  std::vector<std::size_t> positions_;
};

}  // namespace launch
