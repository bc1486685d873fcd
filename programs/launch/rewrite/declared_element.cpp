// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/declared_element.hpp"

#include <algorithm>

namespace launch {

const AttributeSpec* DeclaredElement::attribute(std::string_view name) const {
  if (attributes == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(attributes->begin(), attributes->end(),
                                  [&](const AttributeSpec& each) { return each.name == name; });
  return found == attributes->end() ? nullptr : &*found;
}

DeclaredElement declared_root() {
  return {.holds_actions = true};
}

DeclaredElement declared_in(const DeclaredElement& around, std::string_view tag, const Registry& registry) {
  if (around.recursive != nullptr && around.recursive->tag == tag) {
    return around;
  }
  if (around.items != nullptr) {
    const auto item =
        std::find_if(around.items->begin(), around.items->end(), [&](const ItemSpec& each) { return each.tag == tag; });
    if (item != around.items->end()) {
      return {&item->attributes, &item->items, item->recursive ? &*item : nullptr, false, true};
    }
  }
  if (const ActionType* const action = around.holds_actions ? registry.find(tag) : nullptr) {
    return {&action->attributes, &action->items, nullptr, action->holds_actions, false};
  }
  return {};
}

}  // namespace launch
