// SPDX-License-Identifier: Apache-2.0
// <group>: actions in a scope of their own.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "actions/process/control_group_settings.hpp"
#include "actions/process/machine_settings.hpp"
#include "actions/values/pair_items.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class Group : public Action {
 public:
  explicit Group(Fields fields) : Action(fields.where(), fields.condition()), fields_(std::move(fields)) {}

  Introspection introspect() const override { return {.children = &fields_.actions()}; }

 protected:
  void execute(LaunchContext& context) const override {
    Scope inner = context.scope();
    const auto kept = perform_pairs(fields_, "keep", inner);
    const bool scoped = fields_.boolean("scoped", true).perform(inner);
    if (fields_.has("ns") && !scoped) {
      throw LaunchError("ns needs a scoped group: it ends with the group", fields_.text("ns").where(),
                        "use push_ros_namespace for a namespace that stays", Finding::kExclusive);
    }
    if (scoped && !fields_.boolean("forwarding", true).perform(inner)) {
      inner.clear_configurations();
      inner.environment = context.initial_environment_there();
    }
    if (fields_.has("machine")) {
      if (!scoped) {
        throw LaunchError("machine needs a scoped group: it ends with the group", fields_.text("machine").where(),
                          "leave out scoped=\"false\"", Finding::kExclusive);
      }
      move_to_machine(inner, machine_of(fields_, context), context.initial_environment());
    }
    for (const auto& [name, value] : kept) {
      inner.configurations.insert_or_assign(name, value);
    }
    if (fields_.has("ns")) {
      push_namespace(fields_.text("ns"), inner);
    }
    if (fields_.has("name")) {
      inner.groups.push_back(name(inner));
    }
    ControlGroup shared{.where = fields_.where()};
    perform_settings(control_group_settings(), fields_, inner, shared.limits);
    if (shared.limits.any() && !scoped) {
      throw LaunchError("limits need a scoped group: they are those of the processes in it", fields_.where(),
                        "leave out scoped=\"false\"", Finding::kExclusive);
    }
    if (shared.limits.any()) {
      inner.control_groups.push_back(std::make_shared<const ControlGroup>(std::move(shared)));
    }
    if (scoped) {
      context.visit_in(std::move(inner), fields_.actions());
    } else {
      const std::vector<std::string> outer = context.scope().groups;
      context.scope() = std::move(inner);
      context.visit(fields_.actions());
      context.scope().groups = outer;
    }
  }

 private:
  std::string name(Scope& scope) const {
    std::string text = fields_.text("name").perform(scope);
    if (text.empty() || text.find_first_of(" \t\n*?[,") != std::string::npos) {
      throw LaunchError(fmt::format("'{}' is no name for a group", text), fields_.text("name").where(),
                        "use a name without blanks, commas and the characters of shell patterns",
                        Finding::kInvalidName);
    }
    return text;
  }

  Fields fields_;
};

std::vector<AttributeSpec> group_attributes() {
  std::vector<AttributeSpec> attributes = {
      {"scoped", AttributeType::kBoolean, false, "true", "restore configurations and environment at the end"},
      {"forwarding", AttributeType::kBoolean, false, "true",
       "false: start without configurations and with the launcher's own environment"},
      {"ns", AttributeType::kText, false, "", "namespace of every node in the group", true},
      machine_attribute("the machine of every process in the group; local: this one"),
      {"name", AttributeType::kText, false, "",
       "name by which launch stop --group and others refer to the processes in the group", true}};
  for (AttributeSpec& limit : declared_attributes(control_group_settings())) {
    attributes.push_back(std::move(limit));
  }
  return attributes;
}

}  // namespace

ActionType group_action() {
  return {
      .tag = "group",
      .help = "Visits actions in a scope: what they set ends with the group.",
      .attributes = group_attributes(),
      .items = {pair_item("keep", "a configuration to set inside, evaluated outside", "name of the configuration")},
      .holds_actions = true,
      .make =
          [](Fields fields) {
            check_settings(control_group_settings(), fields);
            return std::make_shared<Group>(std::move(fields));
          },
  };
}

}  // namespace launch
