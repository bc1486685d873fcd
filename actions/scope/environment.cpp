// SPDX-License-Identifier: Apache-2.0
// <set_env>, <unset_env>, <append_env>, <reset_env> and <rep_env>: the launch environment, which $(env …) reads and
// later processes inherit.
#include <fmt/format.h>

#include "actions/row_action.hpp"
#include "actions/values/pair_items.hpp"

namespace launch {

namespace {

struct Variable {
  std::string name = {};
  std::string value = {};
  bool prepend = false;
  std::string separator = ":";
};

Setting<Variable> variable_name() {
  return {.attribute = {"name", AttributeType::kText, true, "", "name of the variable"},
          .place = place_of(&Variable::name)};
}

Setting<Variable> variable_value(const char* help) {
  return {.attribute = {"value", AttributeType::kText, true, "", help}, .place = place_of(&Variable::value)};
}

void perform_settable_name(const Fields& fields, Scope& scope, Variable& variable) {
  const Template& text = fields.text("name");
  variable.name = text.perform(scope);
  if (variable.name.empty() || variable.name.find('=') != std::string::npos) {
    throw LaunchError(fmt::format("'{}' is no name of an environment variable", variable.name), text.where(),
                      variable.name.empty() ? "" : "the name and the value are two attributes");
  }
}

}  // namespace

ActionType append_env_action() {
  return action_of<Variable>(
      {.tag = "append_env", .help = "Appends a value to a variable of the launch environment, or sets it."},
      {variable_name(),
       variable_value("the text to append"),
       {.attribute = {"prepend", AttributeType::kBoolean, false, "false", "true: put the value in front"},
        .place = place_of(&Variable::prepend)},
       {.attribute = {"separator", AttributeType::kText, false, ":", "text between the values"},
        .place = place_of(&Variable::separator)}},
      [](const Fields&, LaunchContext& context, Variable& variable) {
        Environment& environment = context.scope().environment;
        const auto& [name, value, prepend, separator] = variable;
        if (!environment.contains(name)) {
          environment.insert_or_assign(name, value);
          return;
        }
        const std::string& before = environment.at(name);
        environment.insert_or_assign(name, prepend ? value + separator + before : before + separator + value);
      });
}

ActionType reset_env_action() {
  return action_of<NoValues>(
      {.tag = "reset_env", .help = "Restores the environment that the launcher was started with."}, {},
      [](const Fields&, LaunchContext& context, NoValues&) {
        context.scope().environment = context.initial_environment_there();
      });
}

ActionType rep_env_action() {
  return action_of<NoValues>({.tag = "rep_env",
                              .help = "Replaces the whole launch environment.",
                              .items = {pair_item("env", "a variable of the new environment", "name of the variable")}},
                             {}, [](const Fields& fields, LaunchContext& context, NoValues&) {
                               Environment environment;
                               for (const auto& [name, value] : perform_pairs(fields, "env", context.scope())) {
                                 environment.insert_or_assign(name, value);
                               }
                               context.scope().environment = std::move(environment);
                             });
}

ActionType set_env_action() {
  Setting<Variable> name = variable_name();
  name.perform = perform_settable_name;
  return action_of<Variable>({.tag = "set_env", .help = "Sets a variable of the launch environment."},
                             {std::move(name), variable_value("its value")},
                             [](const Fields&, LaunchContext& context, Variable& variable) {
                               Environment& environment = context.scope().environment;
                               environment.insert_or_assign(variable.name, variable.value);
                               environment.decide(variable.name);
                             });
}

ActionType unset_env_action() {
  return action_of<Variable>({.tag = "unset_env", .help = "Removes a variable from the launch environment."},
                             {variable_name()}, [](const Fields&, LaunchContext& context, Variable& variable) {
                               Environment& environment = context.scope().environment;
                               environment.erase(variable.name);
                               environment.decide(variable.name);
                             });
}

}  // namespace launch
