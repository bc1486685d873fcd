// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of a message: "data > 3", "pose.position.x >= 1.5 and not header.frame_id == 'map'".
//
//   condition   comparison, a field of type bool, `not` condition, condition `and` condition, condition `or` condition,
//               (condition)
//   comparison  operand == != < <= > >= operand; chains such as 1 < x < 3 as in Python
//   operand     a field, len(field), a number, a text in quotes, true, false
//
// A field is written as FieldPath has it, with `m.` or `m` alone before it if one likes, as in ROS 2.
#pragma once

#include <functional>
#include <memory>

#include "base/diagnostics/source.hpp"
#include "launcher/message_types/interface_type.hpp"

namespace launch {

class MessageCondition {
 public:
  // Throws LaunchError at the place of a mistake: a field that the message lacks, a text compared with a number.
  MessageCondition(std::shared_ptr<const MessageType> message, const LocatedText& text);

  // A comparison with an element that a sequence does not have does not hold.
  bool holds(const MessageValue& message) const { return holds_(message); }

 private:
  std::function<bool(const MessageValue&)> holds_;
};

}  // namespace launch
