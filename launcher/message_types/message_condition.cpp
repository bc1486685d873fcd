// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/message_condition.hpp"

#include <fmt/format.h>

#include "base/diagnostics/diagnostic.hpp"
#include "base/overloaded.hpp"

namespace launch {

namespace {

FieldContent content_of(const MessageValue& value) {
  return std::visit(Overloaded{[](bool flag) { return FieldContent{std::int64_t{flag}}; },
                               [](const std::string& text) { return FieldContent{std::string_view(text)}; },
                               [](const MessageValue::List& list) { return FieldContent{FieldParts{list.size()}}; },
                               [](auto number) { return FieldContent{number}; }},
                    value.data);
}

}  // namespace

MessageCondition::MessageCondition(std::shared_ptr<const MessageType> message, const LocatedText& text)
    : condition_(text, FieldCondition::Of::kMessages) {
  for (FieldPath path : condition_.fields()) {
    if (std::get<std::string>(path.parts.front().step) == "m" && message->find("m") == nullptr) {
      path.parts.erase(path.parts.begin());
    }
    parts_.emplace_back(message, path, text);
  }
  check(condition_.root());
}

bool MessageCondition::holds(const MessageValue& message) const {
  return condition_.holds([&](std::size_t i) {
    const MessageValue* const value = parts_[i].find(message);
    return value != nullptr ? std::optional(content_of(*value)) : std::nullopt;
  });
}

const char* MessageCondition::name_of(Kind kind) {
  return kind == Kind::kNumber ? "a number" : kind == Kind::kText ? "a text" : "a bool";
}

void MessageCondition::check(const FieldCondition::Node& node) const {
  for (const FieldCondition::Node& part : node.parts) {
    check(part);
  }
  for (std::size_t i = 0; i < node.operands.size(); ++i) {
    const Kind kind = kind_of(node.operands[i]);
    const SourceRange& where = node.operands[i].where;
    if (node.relations.empty() && kind != Kind::kBool) {
      throw LaunchError(fmt::format("{} is no condition", name_of(kind)), where, "compare it, for instance with '> 0'");
    }
    if (i > 0 && kind != kind_of(node.operands[i - 1])) {
      throw LaunchError(
          fmt::format("{} can't be compared with {}", name_of(kind_of(node.operands[i - 1])), name_of(kind)), where);
    }
  }
}

MessageCondition::Kind MessageCondition::kind_of(const FieldCondition::Operand& operand) const {
  using OperandKind = FieldCondition::Operand::Kind;
  if (operand.kind == OperandKind::kBool || operand.kind == OperandKind::kText) {
    return operand.kind == OperandKind::kBool ? Kind::kBool : Kind::kText;
  }
  if (operand.kind == OperandKind::kNumber) {
    return Kind::kNumber;
  }
  const FieldType& type = parts_[operand.field].type();
  const bool is_text = type.kind == FieldKind::kString || type.kind == FieldKind::kWstring;
  if (operand.kind == OperandKind::kLength) {
    if (type.many == Many::kOne && !is_text) {
      throw LaunchError(fmt::format("{} has no length", to_string(type)), operand.where);
    }
    return Kind::kNumber;
  }
  if (type.many != Many::kOne || type.kind == FieldKind::kMessage) {
    throw LaunchError(fmt::format("{} can't be compared as a whole", to_string(type)), operand.where,
                      type.many != Many::kOne ? "choose an element, such as [0], or its length, len(field)"
                                              : "choose a field of it with a point");
  }
  return type.kind == FieldKind::kBool ? Kind::kBool : is_text ? Kind::kText : Kind::kNumber;
}

}  // namespace launch
