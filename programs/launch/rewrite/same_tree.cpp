// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/same_tree.hpp"

#include <algorithm>

namespace launch {

namespace {

bool is_same_value(const Value& left, const Value& right) {
  if (left.data.index() != right.data.index()) {
    return false;
  }
  if (const Scalar* const scalar = left.scalar()) {
    return scalar->type == right.scalar()->type && scalar->text.text() == right.scalar()->text.text();
  }
  return std::equal(left.list()->begin(), left.list()->end(), right.list()->begin(), right.list()->end(),
                    is_same_value);
}

}  // namespace

bool is_same_tree(const Entity& left, const Entity& right) {
  const auto is_in_right = [&](const Attribute& attribute) {
    const Attribute* const other = right.find(attribute.name);
    return other != nullptr && is_same_value(attribute.value, other->value);
  };
  return left.type_name == right.type_name && left.attributes.size() == right.attributes.size() &&
         left.has_children_list == right.has_children_list &&
         std::all_of(left.attributes.begin(), left.attributes.end(), is_in_right) &&
         std::equal(left.children.begin(), left.children.end(), right.children.begin(), right.children.end(),
                    is_same_tree);
}

}  // namespace launch
