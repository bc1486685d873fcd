// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of a message: "data > 3", "pose.position.x >= 1.5 and not header.frame_id == 'map'". Its
// grammar is that of FieldCondition. A field may have `m.` before it, or be `m` alone, as in ROS 2.
#pragma once

#include <memory>
#include <vector>

#include "base/conditions/field_condition.hpp"
#include "launcher/message_types/message_part.hpp"

namespace launch {

class MessageCondition {
 public:
  // Throws LaunchError at the place of a mistake: a field that the message lacks, a text compared with a number.
  MessageCondition(std::shared_ptr<const MessageType> message, const LocatedText& text);

  // A comparison with an element that a sequence does not have does not hold.
  bool holds(const MessageValue& message) const;

 private:
  enum class Kind { kNumber, kText, kBool };
  static const char* name_of(Kind kind);
  // Throw LaunchError where kinds do not fit.
  void check(const FieldCondition::Node& node) const;
  Kind kind_of(const FieldCondition::Operand& operand) const;

  FieldCondition condition_;
  std::vector<MessagePart> parts_;  // for each of the condition's fields
};

}  // namespace launch
