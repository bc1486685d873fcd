// SPDX-License-Identifier: Apache-2.0
// What the registry says of an element of a launch file.
#pragma once

#include <string_view>
#include <vector>

#include "launcher/language/registry.hpp"

namespace launch {

// The declaration of an action, or of an item of one; of the root, which holds actions; or of nothing.
struct DeclaredElement {
  const std::vector<AttributeSpec>* attributes = nullptr;
  const std::vector<ItemSpec>* items = nullptr;
  const ItemSpec* recursive = nullptr;
  bool holds_actions = false;
  bool is_item = false;

  const AttributeSpec* attribute(std::string_view name) const;
};

DeclaredElement declared_root();
DeclaredElement declared_in(const DeclaredElement& around, std::string_view tag, const Registry& registry);

}  // namespace launch
