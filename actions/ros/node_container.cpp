// SPDX-License-Identifier: Apache-2.0
// <node_container …>: runs a component container and loads nodes into it.
#include "actions/ros/composable_nodes.hpp"
#include "actions/ros/node_process.hpp"

namespace launch {

namespace {

class ComposableNodeContainer : public Action {
 public:
  explicit ComposableNodeContainer(const Fields& fields)
      : Action(fields.where(), fields.condition()), container_(fields), nodes_(fields) {}

 protected:
  void execute(LaunchContext& context) const override {
    const std::string name = container_.request(context);
    nodes_.request(context, name, context.requests().processes.back().environment, where());
  }

 private:
  NodeProcess container_;
  ComposableNodes nodes_;
};

}  // namespace

ActionType node_container_action() {
  std::vector<ItemSpec> items = NodeProcess::items();
  for (ItemSpec& item : ComposableNodes::items()) {
    items.push_back(std::move(item));
  }
  return {
      .tag = "node_container",
      .help = "Runs a component container and loads nodes into it.",
      .attributes = NodeProcess::attributes(true),
      .items = std::move(items),
      .make = [](const Fields& fields) { return std::make_shared<ComposableNodeContainer>(fields); },
  };
}

}  // namespace launch
