// SPDX-License-Identifier: Apache-2.0
// A condition on the fields of an event: `data > 3 && topic_name == "/chatter"`. Its grammar is that of
// launch::FieldCondition.
//
// A field is a field of the payload, a member of one of its structures (`a.b`), an element (`gid[0]`), `cpu_id`, or a
// context such as `vpid`, if the payload has no field of this name.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/conditions/field_condition.hpp"
#include "tracing/decode/reader/event.hpp"

namespace tracing {

class EventCondition {
 public:
  // Throws launch::LaunchError. The begin of its place is a byte of `text`.
  explicit EventCondition(std::string_view text);

  bool holds(const Event& event) const;
  // The same for an event that is stored in another way. `look_up` returns nothing for a field that the event lacks.
  using LookUp = std::function<std::optional<launch::FieldContent>(const launch::FieldPath&)>;
  bool holds(const LookUp& look_up) const;

  // The first names of all paths in the condition, in their order, each once.
  std::vector<std::string> fields() const;

 private:
  launch::FieldCondition condition_;
};

}  // namespace tracing
