// SPDX-License-Identifier: Apache-2.0
#include "base/conditions/field_condition.hpp"

#include <algorithm>
#include <compare>
#include <utility>

namespace launch {

namespace {

using Relation = FieldCondition::Relation;
using Operand = FieldCondition::Operand;
using Node = FieldCondition::Node;

std::optional<FieldContent> content_of(const Operand& operand, const FieldCondition::LookUp& look_up) {
  if (operand.kind == Operand::Kind::kField) {
    return look_up(operand.field);
  }
  if (operand.kind == Operand::Kind::kLength) {
    const auto content = look_up(operand.field);
    const auto* const text = content ? std::get_if<std::string_view>(&content->value) : nullptr;
    const auto* const parts = content ? std::get_if<FieldParts>(&content->value) : nullptr;
    return text != nullptr    ? std::optional(FieldContent{std::uint64_t{text->size()}})
           : parts != nullptr ? std::optional(FieldContent{std::uint64_t{parts->count}})
                              : std::nullopt;
  }
  return std::visit(
      []<class T>(const T& value) {
        if constexpr (std::is_same_v<T, std::string>) {
          return FieldContent{std::string_view(value)};
        } else {
          return FieldContent{value};
        }
      },
      operand.value);
}

std::optional<std::string_view> text_of(const FieldContent& content) {
  const auto* const text = std::get_if<std::string_view>(&content.value);
  return text != nullptr ? std::optional(*text) : content.label;
}

// Integers keep all 64 bits, with or without sign. Nothing if the values are of different kinds.
std::optional<std::partial_ordering> compare(const FieldContent& left, const FieldContent& right) {
  return std::visit(
      [&]<class A, class B>(const A& a, const B& b) -> std::optional<std::partial_ordering> {
        if constexpr (std::is_same_v<A, std::string_view> || std::is_same_v<B, std::string_view>) {
          const auto first = text_of(left);
          const auto second = text_of(right);
          return first && second ? std::optional<std::partial_ordering>(*first <=> *second) : std::nullopt;
        } else if constexpr (std::is_same_v<A, FieldParts> || std::is_same_v<B, FieldParts>) {
          return std::nullopt;
        } else if constexpr (std::is_same_v<A, double> || std::is_same_v<B, double>) {
          return static_cast<double>(a) <=> static_cast<double>(b);
        } else {
          return std::cmp_less(a, b)    ? std::partial_ordering::less
                 : std::cmp_equal(a, b) ? std::partial_ordering::equivalent
                                        : std::partial_ordering::greater;
        }
      },
      left.value, right.value);
}

bool is_true(Relation relation, std::partial_ordering order) {
  switch (relation) {
    case Relation::kEqual:
      return std::is_eq(order);
    case Relation::kNotEqual:
      return std::is_neq(order);
    case Relation::kLess:
      return std::is_lt(order);
    case Relation::kLessOrEqual:
      return std::is_lteq(order);
    case Relation::kGreater:
      return std::is_gt(order);
    case Relation::kGreaterOrEqual:
      return std::is_gteq(order);
    case Relation::kMatches:
      break;
  }
  return false;
}

bool is_true(const FieldContent& content) {
  return std::visit(
      []<class T>(const T& value) {
        if constexpr (std::is_same_v<T, std::string_view>) {
          return !value.empty();
        } else if constexpr (std::is_same_v<T, FieldParts>) {
          return value.count > 0;
        } else {
          return value != 0;
        }
      },
      content.value);
}

bool compares(const Node& comparison, const FieldCondition::LookUp& look_up) {
  auto left = content_of(comparison.operands.front(), look_up);
  if (comparison.relations.empty()) {
    return left && is_true(*left);
  }
  for (std::size_t i = 0; i < comparison.relations.size(); ++i) {
    const Operand& operand = comparison.operands[i + 1];
    const auto right = content_of(operand, look_up);
    if (!left || !right) {
      return false;
    }
    if (comparison.relations[i] == Relation::kMatches) {
      const auto text = text_of(*left);
      if (!text || !operand.matches(*text)) {
        return false;
      }
    } else if (const auto order = compare(*left, *right); !order || !is_true(comparison.relations[i], *order)) {
      return false;
    }
    left = right;
  }
  return true;
}

bool holds_here(const Node& node, const FieldCondition::LookUp& look_up) {
  const auto part_holds = [&](const Node& part) { return holds_here(part, look_up); };
  switch (node.kind) {
    case Node::Kind::kOr:
      return std::any_of(node.parts.begin(), node.parts.end(), part_holds);
    case Node::Kind::kAnd:
      return std::all_of(node.parts.begin(), node.parts.end(), part_holds);
    case Node::Kind::kNot:
      return !holds_here(node.parts.front(), look_up);
    case Node::Kind::kComparison:
      return compares(node, look_up);
  }
  return false;
}

}  // namespace

bool FieldCondition::holds(const LookUp& look_up) const {
  return holds_here(root_, look_up);
}

}  // namespace launch
