// SPDX-License-Identifier: Apache-2.0
// A part of a message, which a FieldPath names. It is looked up in the type once, and then found in each message.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/conditions/field_path.hpp"
#include "launcher/message_types/interface_type.hpp"

namespace launch {

class MessagePart {
 public:
  // `text` is where the path stands. Throws LaunchError at the part of the path that does not exist.
  MessagePart(std::shared_ptr<const MessageType> message, const FieldPath& path, const LocatedText& text);
  MessagePart(std::shared_ptr<const MessageType> message, const LocatedText& path)
      : MessagePart(std::move(message), FieldPath::parse(path), path) {}

  const FieldType& type() const { return type_; }
  // Null if a sequence of the message is too short.
  const MessageValue* find(const MessageValue& message) const;

 private:
  FieldType type_;
  std::vector<std::size_t> positions_;
};

}  // namespace launch
