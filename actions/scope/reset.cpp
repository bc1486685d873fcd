// SPDX-License-Identifier: Apache-2.0
// <reset>: forgets all launch configurations except the entries of `keep`.
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class ResetLaunchConfigurations : public Action {
 public:
  explicit ResetLaunchConfigurations(const Fields& fields) : Action(fields.where(), fields.condition()) {
    for (const Fields* keep : fields.items("keep")) {
      keep_.emplace_back(keep->text("name"), keep->text("value"));
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    std::map<std::string, std::string> kept;
    for (const auto& [name, value] : keep_) {
      kept.insert_or_assign(name.perform(scope), value.perform(scope));
    }
    scope.clear_configurations();
    scope.configurations = std::move(kept);
  }

 private:
  std::vector<std::pair<Template, Template>> keep_;
};

}  // namespace

ActionType reset_action() {
  return {
      .tag = "reset",
      .help = "Removes all launch configurations, and the namespace, parameters and remaps of the scope.",
      .attributes = {},
      .items = {{"keep",
                 "a configuration to set afterwards, evaluated before",
                 {{"name", AttributeType::kText, true, "", "name of the configuration"},
                  {"value", AttributeType::kText, true, "", "its value"}}}},
      .make = [](const Fields& fields) { return std::make_shared<ResetLaunchConfigurations>(fields); },
  };
}

}  // namespace launch
