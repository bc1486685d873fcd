// SPDX-License-Identifier: Apache-2.0
// The attributes of a <fault> of messages: do="drop|duplicate|corrupt|delay", with topic="…" or service="…".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actions/values/range_field.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/fault_draw.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What the attributes are in a scope, before anything is drawn.
struct MessageFaultRanges {
  MessageFault fault;
  NumberRange first;
  NumberRange every;
  std::optional<NumberRange> count;  // nullopt: no end
  NumberRange by;

  std::string identity() const;
  bool is_random() const;
  MessageFault draw(const FaultDraw& draw) const;
};

class MessageFaultFields {
 public:
  // The attributes of the ActionType.
  static std::vector<AttributeSpec> attributes();

  // Throws LaunchError when attributes don't go together.
  MessageFaultFields(const Fields& fields, MessageFault::Kind kind);

  // Throws LaunchError.
  MessageFaultRanges perform(Scope& scope) const;

 private:
  MessageFault::Kind kind_;
  MessageFault::Side side_;
  Template name_;  // of the topic or the service
  std::optional<Template> node_;
  bool has_end_;
  std::optional<RangeField> occurrence_;
  std::optional<RangeField> every_;
  std::optional<RangeField> count_;
  std::optional<RangeField> by_;
};

}  // namespace launch
