// SPDX-License-Identifier: Apache-2.0
// <set_remap from="…" to="…"/>: a remap of every later node of the scope, before the node's own.
#include "actions/process/process_findings.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetRemap : public Action {
 public:
  explicit SetRemap(const Fields& fields)
      : Action(fields.where(), fields.condition()), from_(fields.text("from")), to_(fields.text("to")) {}

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    std::string from = from_.perform(scope);
    std::string to = to_.perform(scope);
    find_invalid_remap(from, from_.where(), to, to_.where(), context);
    scope.global_remaps.emplace_back(std::move(from), std::move(to));
  }

 private:
  Template from_;
  Template to_;
};

}  // namespace

ActionType set_remap_action() {
  return {
      .tag = "set_remap",
      .help =
          "Renames a topic, a service or an action for every later node of the scope. It wins over a node's own remap.",
      .attributes = {{"from", AttributeType::kText, true, "", "the name in the programs"},
                     {"to", AttributeType::kText, true, "", "the name to use"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetRemap>(fields); },
  };
}

}  // namespace launch
