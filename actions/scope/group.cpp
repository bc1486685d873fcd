// SPDX-License-Identifier: Apache-2.0
// <group>: actions in a scope of their own.
#include "actions/values/ros_names.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class Group : public Action {
 public:
  explicit Group(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        scoped_(fields.boolean("scoped", true)),
        forwarding_(fields.boolean("forwarding", true)),
        namespace_(fields.optional_text("ns")),
        actions_(fields.actions()) {
    for (const Fields* keep : fields.items("keep")) {
      keep_.emplace_back(keep->text("name"), keep->text("value"));
    }
  }

  Introspection introspect() const override { return {.children = &actions_}; }

 protected:
  void execute(LaunchContext& context) const override {
    Scope inner = context.scope();
    std::map<std::string, std::string> kept;
    for (const auto& [name, value] : keep_) {
      kept.insert_or_assign(name.perform(inner), value.perform(inner));
    }
    const bool scoped = scoped_.perform(inner);
    if (namespace_ && !scoped) {
      throw LaunchError("ns needs a scoped group: it ends with the group", namespace_->where(),
                        "use push_ros_namespace for a namespace that stays", Finding::kExclusive);
    }
    if (scoped && !forwarding_.perform(inner)) {
      inner.clear_configurations();
      inner.environment = context.initial_environment();
    }
    for (auto& [name, value] : kept) {
      inner.configurations.insert_or_assign(name, value);
    }
    if (namespace_) {
      push_namespace(*namespace_, inner);
    }
    if (scoped) {
      context.visit_in(std::move(inner), actions_);
    } else {
      context.scope() = std::move(inner);
      context.visit(actions_);
    }
  }

 private:
  BooleanField scoped_;
  BooleanField forwarding_;
  std::optional<Template> namespace_;
  std::vector<std::pair<Template, Template>> keep_;
  std::vector<ActionPtr> actions_;
};

}  // namespace

ActionType group_action() {
  return {
      .tag = "group",
      .help = "Visits actions in a scope: what they set ends with the group.",
      .attributes = {{"scoped", AttributeType::kBoolean, false, "true",
                      "restore configurations and environment at the end"},
                     {"forwarding", AttributeType::kBoolean, false, "true",
                      "false: start without configurations and with the launcher's own environment"},
                     {"ns", AttributeType::kText, false, "", "namespace of every node in the group", true}},
      .items = {{"keep",
                 "a configuration to set inside, evaluated outside",
                 {{"name", AttributeType::kText, true, "", "name of the configuration"},
                  {"value", AttributeType::kText, true, "", "its value"}}}},
      .holds_actions = true,
      .make = [](const Fields& fields) { return std::make_shared<Group>(fields); },
  };
}

}  // namespace launch
