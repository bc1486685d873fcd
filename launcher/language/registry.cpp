// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/registry.hpp"

#include <stdexcept>

namespace launch {

void Registry::add(ActionType type) {
  std::string tag = type.tag;
  if (!types_.emplace(tag, std::move(type)).second) {
    throw std::logic_error("two actions are declared with the tag '" + tag + "'");
  }
}

const ActionType* Registry::find(std::string_view tag) const {
  const auto found = types_.find(tag);
  return found == types_.end() ? nullptr : &found->second;
}

}  // namespace launch
