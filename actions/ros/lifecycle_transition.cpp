// SPDX-License-Identifier: Apache-2.0
// <lifecycle_transition node="…" transitions="configure activate"/>: changes the state of a managed node.
#include "actions/ros/lifecycle_names.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class LifecycleTransition : public Action {
 public:
  explicit LifecycleTransition(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        node_(fields.text("node")),
        transitions_(fields.words("transitions")) {
    if (transitions_.empty()) {
      throw LaunchError("transitions names none", fields.where("transitions"),
                        "configure, activate, deactivate, cleanup or shutdown, separated by spaces");
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    TransitionRequest request;
    request.node = resolve_name(node_, scope);
    for (const Template& word : transitions_) {
      request.transitions.push_back(word.perform(scope));
      require_transition(request.transitions.back(), word.where());
    }
    request.environment = scope.environment;
    request.origin = where();
    context.requests().transitions.push_back(std::move(request));
  }

 private:
  Template node_;
  std::vector<Template> transitions_;
};

}  // namespace

ActionType lifecycle_transition_action() {
  return {
      .tag = "lifecycle_transition",
      .help = "Changes the state of a node with a managed life cycle, one transition after another until one fails.",
      .attributes = {{"node", AttributeType::kText, true, "",
                      "the node; a relative name is below the namespace of the scope"},
                     {"transitions", AttributeType::kCommandLine, true, "",
                      "configure, activate, deactivate, cleanup, shutdown, separated by spaces"}},
      .items = {},
      .extension = true,
      .make = [](const Fields& fields) { return std::make_shared<LifecycleTransition>(fields); },
  };
}

}  // namespace launch
