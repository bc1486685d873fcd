// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

class Walk {
 public:
  explicit Walk(const Registry& registry) : registry_(registry) {}

  void actions(const std::vector<Entity>& entities) {
    for (const Entity& entity : entities) {
      if (const ActionType* const type = registry_.find(entity.type_name)) {
        action(entity, *type);
      }
    }
  }

  std::vector<Diagnostic> found;

 private:
  void refuse(const std::string& what, const SourceRange& where) {
    found.push_back({Severity::kError, what + " is not known to ros2 launch", where, {}, Finding::kExtension});
  }

  void action(const Entity& entity, const ActionType& type) {
    if (type.extension) {
      refuse(fmt::format("<{}>", entity.type_name), entity.where);
    }
    attributes(entity, type.attributes);
    for (const Entity& child : entity.children) {
      if (const ItemSpec* const item = find(type.items, child.type_name)) {
        this->item(child, *item);
      } else if (type.holds_actions) {
        actions({child});
      }
    }
  }

  void item(const Entity& entity, const ItemSpec& spec) {
    if (spec.extension) {
      refuse(fmt::format("<{}>", entity.type_name), entity.where);
    }
    attributes(entity, spec.attributes);
    for (const Entity& child : entity.children) {
      if (const ItemSpec* const nested = find(spec.items, child.type_name)) {
        item(child, *nested);
      } else if (spec.recursive && child.type_name == spec.tag) {
        item(child, spec);
      }
    }
  }

  void attributes(const Entity& entity, const std::vector<AttributeSpec>& specs) {
    for (const Attribute& attribute : entity.attributes) {
      const auto spec = std::find_if(specs.begin(), specs.end(),
                                     [&](const AttributeSpec& one) { return one.name == attribute.name; });
      if (spec != specs.end() && spec->extension) {
        refuse(fmt::format("attribute '{}' of <{}>", attribute.name, entity.type_name), attribute.name_where);
      }
    }
  }

  static const ItemSpec* find(const std::vector<ItemSpec>& items, const std::string& tag) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const ItemSpec& item) { return item.tag == tag; });
    return found == items.end() ? nullptr : &*found;
  }

  const Registry& registry_;
};

}  // namespace

std::vector<Diagnostic> beyond_ros2(const std::shared_ptr<const SourceFile>& file, const Registry& registry) {
  Walk walk(registry);
  if (file != nullptr && !file->path().ends_with(".py")) {
    walk.actions(load_entity_tree(file).children);
  }
  return std::move(walk.found);
}

}  // namespace launch
