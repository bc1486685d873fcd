// SPDX-License-Identifier: Apache-2.0
// <let name="…" value="…"/>, <unset name="…"/> and <reset>: set and remove launch configurations.
#include "actions/row_action.hpp"
#include "actions/values/pair_items.hpp"

namespace launch {

namespace {

struct Configuration {
  std::string name = {};
  std::string value = {};
};

Setting<Configuration> configuration_name() {
  return {.attribute = {"name", AttributeType::kText, true, "", "name of the configuration"},
          .place = place_of(&Configuration::name)};
}

}  // namespace

ActionType unset_action() {
  return action_of<Configuration>(
      {.tag = "unset", .help = "Removes a launch configuration; no error when there is none."}, {configuration_name()},
      [](const Fields&, LaunchContext& context, Configuration& configuration) {
        context.scope().configurations.erase(configuration.name);
      });
}

ActionType let_action() {
  return action_of<Configuration>(
      {.tag = "let", .help = "Sets a launch configuration, whatever it was before."},
      {configuration_name(),
       {.attribute = {"value", AttributeType::kText, true, "", "its value"}, .place = place_of(&Configuration::value)}},
      [](const Fields&, LaunchContext& context, Configuration& let) {
        context.scope().configurations.insert_or_assign(let.name, let.value);
      });
}

ActionType reset_action() {
  return action_of<NoValues>(
      {.tag = "reset",
       .help = "Removes all launch configurations, and the namespace, parameters and remaps of the scope.",
       .items = {pair_item("keep", "a configuration to set afterwards, evaluated before",
                           "name of the configuration")}},
      {}, [](const Fields& fields, LaunchContext& context, NoValues&) {
        Scope& scope = context.scope();
        const auto kept = perform_pairs(fields, "keep", scope);
        scope.clear_configurations();
        for (const auto& [name, value] : kept) {
          scope.configurations.insert_or_assign(name, value);
        }
      });
}

}  // namespace launch
