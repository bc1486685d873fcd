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

void Registry::add_loader(std::string ending, LaunchFileLoader loader) {
  loaders_.insert_or_assign(std::move(ending), std::move(loader));
}

const LaunchFileLoader* Registry::find_loader(std::string_view path) const {
  for (const auto& [ending, loader] : loaders_) {
    if (path.ends_with(ending)) {
      return &loader;
    }
  }
  return nullptr;
}

}  // namespace launch
