// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/event_condition.hpp"

#include <algorithm>
#include <memory>

namespace tracing {

namespace {

using launch::FieldContent;
using launch::FieldParts;
using launch::FieldPath;

std::optional<FieldValue> inside(FieldValue field, const FieldPath::Part& part) {
  if (field.is_variant()) {
    field = field[0];
  }
  if (const auto* const index = std::get_if<std::size_t>(&part.step)) {
    return field.is_array() && *index < field.size() ? std::optional(field[*index]) : std::nullopt;
  }
  if (!field.is_structure()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field.member_name(i) == std::get<std::string>(part.step)) {
      return field[i];
    }
  }
  return std::nullopt;
}

FieldContent content_of(const FieldValue& field) {
  FieldContent content;
  content.label = field.enumeration_label();
  if (const auto number = field.integer()) {
    content.value = *number;
  } else if (const auto large = field.unsigned_integer()) {
    content.value = *large;
  } else if (const auto real = field.real()) {
    content.value = *real;
  } else if (const auto text = field.string()) {
    content.value = *text;
  } else {
    content.value = FieldParts{field.size()};
  }
  return content;
}

std::optional<FieldContent> look_up_in(const Event& event, const FieldPath& path) {
  const auto& name = std::get<std::string>(path.parts.front().step);
  if (path.parts.size() == 1) {
    if (name == "procname") {
      return event.procname ? std::optional(FieldContent{*event.procname, {}}) : std::nullopt;
    }
    const auto* const context = name == "vpid"     ? &event.vpid
                                : name == "vtid"   ? &event.vtid
                                : name == "cpu_id" ? &event.cpu_id
                                                   : nullptr;
    if (context != nullptr) {
      return *context ? std::optional(FieldContent{**context, {}}) : std::nullopt;
    }
  }
  std::optional<FieldValue> field = event.field(name);
  if (!field) {
    field = event.context(name);
  }
  for (std::size_t i = 1; i < path.parts.size(); ++i) {
    if (!field) {
      return std::nullopt;
    }
    field = inside(*field, path.parts[i]);
  }
  if (!field) {
    return std::nullopt;
  }
  if (field->is_variant()) {
    field = (*field)[0];
  }
  return content_of(*field);
}

}  // namespace

EventCondition::EventCondition(std::string_view text)
    : condition_(
          launch::LocatedText(std::string(text), {std::make_shared<launch::SourceFile>("condition", std::string(text)),
                                                  0, static_cast<std::uint32_t>(text.size())}),
          launch::FieldCondition::Of::kEvents) {}

bool EventCondition::holds(const Event& event) const {
  return condition_.holds([&](std::size_t i) { return look_up_in(event, condition_.fields()[i]); });
}

bool EventCondition::holds(const LookUp& look_up) const {
  return condition_.holds([&](std::size_t i) { return look_up(condition_.fields()[i]); });
}

std::vector<std::string> EventCondition::fields() const {
  std::vector<std::string> names;
  for (const FieldPath& path : condition_.fields()) {
    const auto& name = std::get<std::string>(path.parts.front().step);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace tracing
