// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/frontend/entity_equivalence.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

constexpr std::string_view kSeparatorSuffix = "-sep";

bool same_scalar(const Scalar& left, const Scalar& right) {
  using Type = Scalar::Type;
  if (left.text.text() == right.text.text()) {
    const bool untyped = left.type == Type::kUntyped || right.type == Type::kUntyped;
    return untyped || left.type == right.type;
  }
  // The text of an XML file is coerced to the type of the YAML value.
  const Scalar a = left.type == Type::kUntyped ? yaml11_scalar(left.text) : left;
  const Scalar b = right.type == Type::kUntyped ? yaml11_scalar(right.text) : right;
  const auto number = [](const Scalar& scalar) -> std::optional<double> {
    if (scalar.type == Type::kInt) {
      return static_cast<double>(scalar.int_value);
    }
    return scalar.type == Type::kFloat ? std::optional(scalar.float_value) : std::nullopt;
  };
  if (a.type == Type::kBool && b.type == Type::kBool) {
    return a.bool_value == b.bool_value;
  }
  if (a.type == Type::kInt && b.type == Type::kInt) {
    return a.int_value == b.int_value;
  }
  const bool coerced = left.type == Type::kUntyped || right.type == Type::kUntyped;
  if (number(a) && number(b) && (coerced || a.type == b.type)) {
    return *number(a) == *number(b) || (std::isnan(*number(a)) && std::isnan(*number(b)));
  }
  return a.type == Type::kNull && b.type == Type::kNull;
}

bool same_value(const Value& left, const Value& right);

bool same_list(const std::vector<Value>& left, const std::vector<Value>& right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), same_value);
}

bool same_value(const Value& left, const Value& right) {
  if (left.scalar() != nullptr && right.scalar() != nullptr) {
    return same_scalar(*left.scalar(), *right.scalar());
  }
  if (left.list() != nullptr && right.list() != nullptr) {
    return same_list(*left.list(), *right.list());
  }
  // One is a list of YAML. The other may be a text of XML that holds a list.
  const Value& text = left.scalar() != nullptr ? left : right;
  const Value& list = left.scalar() != nullptr ? right : left;
  if (text.scalar()->type != Scalar::Type::kUntyped) {
    return false;
  }
  try {
    const Value typed = yaml11_value(text.scalar()->text);
    return typed.list() != nullptr && same_list(*typed.list(), *list.list());
  } catch (const LaunchError&) {
    return false;
  }
}

// The value of an attribute. If the attribute has a companion NAME-sep, the value is split at this separator.
Value separated(const Entity& entity, const Attribute& attribute) {
  const Attribute* companion = entity.find(attribute.name + std::string(kSeparatorSuffix));
  const Scalar* text = attribute.value.scalar();
  if (companion == nullptr || text == nullptr || companion->value.scalar() == nullptr) {
    return attribute.value;
  }
  const std::string& separator = companion->value.scalar()->text.text();
  std::string_view rest = text->text.text();
  std::vector<Value> items;
  for (bool more = !separator.empty(); more;) {
    const std::size_t end = rest.find(separator);
    Scalar item;
    item.text = LocatedText(std::string(rest.substr(0, end)));
    items.push_back({std::move(item), {}});
    more = end != std::string_view::npos;
    rest.remove_prefix(more ? end + separator.size() : rest.size());
  }
  return {std::move(items), attribute.value.where};
}

bool is_companion(const Entity& entity, const Attribute& attribute) {
  const std::string_view name = attribute.name;
  return name.ends_with(kSeparatorSuffix) &&
         entity.find(name.substr(0, name.size() - kSeparatorSuffix.size())) != nullptr;
}

bool same_attributes(const Entity& left, const Entity& right) {
  const auto count = [](const Entity& entity) {
    return std::count_if(entity.attributes.begin(), entity.attributes.end(),
                         [&](const Attribute& attribute) { return !is_companion(entity, attribute); });
  };
  return count(left) == count(right) &&
         std::all_of(left.attributes.begin(), left.attributes.end(), [&](const Attribute& attribute) {
           if (is_companion(left, attribute)) {
             return true;
           }
           const Attribute* other = right.find(attribute.name);
           return other != nullptr && same_value(separated(left, attribute), separated(right, *other));
         });
}

// YAML groups structured items by name. So if a name has structured items in YAML, only the order of the items of this
// name counts.
bool same_children(const Entity& left, const Entity& right) {
  std::set<std::string_view> structured;
  for (const Entity* entity : {&left, &right}) {
    for (const Entity& child : entity->children) {
      if (child.is_structured_item) {
        structured.insert(child.type_name);
      }
    }
  }
  // Sub-actions come first, under the empty name.
  const auto groups = [&](const Entity& entity) {
    std::map<std::string_view, std::vector<const Entity*>> result;
    for (const Entity& child : entity.children) {
      result[structured.count(child.type_name) > 0 ? std::string_view(child.type_name) : ""].push_back(&child);
    }
    return result;
  };
  const auto left_groups = groups(left);
  const auto right_groups = groups(right);
  return std::equal(left_groups.begin(), left_groups.end(), right_groups.begin(), right_groups.end(),
                    [](const auto& a, const auto& b) {
                      return a.first == b.first &&
                             std::equal(a.second.begin(), a.second.end(), b.second.begin(), b.second.end(),
                                        [](const Entity* x, const Entity* y) { return equivalent(*x, *y); });
                    });
}

}  // namespace

bool equivalent(const Entity& left, const Entity& right) {
  return left.type_name == right.type_name && same_attributes(left, right) && same_children(left, right);
}

}  // namespace launch
