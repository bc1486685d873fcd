// SPDX-License-Identifier: Apache-2.0
// Checks an entity tree against the declarations of the registry and makes its actions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/entity.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

class ActionParser {
 public:
  explicit ActionParser(const Registry& registry) : registry_(registry) {}

  // Makes the actions of `entities`. Finds every error of the tree, and then throws one LaunchError with all of them.
  // Frees each entity when its action is made.
  std::vector<ActionPtr> parse(std::vector<Entity> entities);

 private:
  // The structured items that an entity may hold.
  struct Items {
    const std::vector<ItemSpec>& declared;
    const ItemSpec* recursive = nullptr;  // the item itself, if it may hold items of its own tag

    const ItemSpec* find(std::string_view tag) const;
    std::vector<std::string> tags() const;
  };

  ActionPtr parse_action(const Entity& entity);
  // `items` are the items that may stand beside the attributes.
  void parse_attributes(const Entity& entity, const std::vector<AttributeSpec>& specs, const Items& items,
                        bool conditions, Fields& fields);
  // The action that no declaration makes; null when there is none, or an error of it was kept.
  ActionPtr parse_foreign_action(const Entity& entity, bool& known);
  void parse_condition(const Entity& entity, Fields& fields);
  void parse_item(const Entity& entity, const ItemSpec& spec, Fields& fields);
  Fields::Parsed parse_value(const Entity& entity, const Attribute& attribute, const AttributeSpec& spec) const;
  void report_unknown_action(const Entity& entity, std::vector<std::string> known, std::string_view what);
  void report_unknown_child(const Entity& parent, const Entity& child, const Items& items);
  // Whether an action can hold items of this tag.
  bool is_item_somewhere(const std::string& tag) const;
  // Runs `step` and keeps the errors that it throws.
  template <typename Step>
  void collect(Step step);

  const Registry& registry_;
  std::vector<Diagnostic> errors_;
};

}  // namespace launch
