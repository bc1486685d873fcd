// SPDX-License-Identifier: Apache-2.0
// <load_composable_node target="…">: loads nodes into a running container.
#include "actions/ros/composable_nodes.hpp"

namespace launch {

namespace {

class LoadComposableNodes : public Action {
 public:
  explicit LoadComposableNodes(const Fields& fields)
      : Action(fields.where(), fields.condition()), target_(fields.text("target")), nodes_(fields) {
    if (nodes_.empty()) {
      throw LaunchError("load_composable_node needs a composable_node", fields.where(),
                        "write <composable_node pkg=\"…\" plugin=\"…\" name=\"…\"/> inside",
                        Finding::kMissingAttribute);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    nodes_.request(context, target_.perform(scope), scope.environment, where());
  }

 private:
  Template target_;
  ComposableNodes nodes_;
};

}  // namespace

ActionType load_composable_node_action() {
  return {
      .tag = "load_composable_node",
      .help = "Loads nodes into a component container that runs already.",
      .attributes = {{"target", AttributeType::kText, true, "",
                      "node name of the container; the scope's namespace is not put before it"}},
      .items = ComposableNodes::items(),
      .make = [](const Fields& fields) { return std::make_shared<LoadComposableNodes>(fields); },
  };
}

}  // namespace launch
