// SPDX-License-Identifier: Apache-2.0
// <lifecycle_node …>: runs a ROS node with a managed life cycle.
#include "actions/ros/node_process.hpp"

namespace launch {

namespace {

class LifecycleNode : public Action {
 public:
  explicit LifecycleNode(const Fields& fields)
      : Action(fields.where(), fields.condition()), node_(fields), autostart_(fields.boolean("autostart", false)) {}

 protected:
  void execute(LaunchContext& context) const override {
    const bool autostart = autostart_.perform(context.scope());
    const std::string name = node_.request(context);
    if (autostart) {
      Requests& requests = context.requests();
      requests.transitions.push_back(
          {name, {"configure", "activate"}, true, requests.processes.back().environment, where()});
    }
  }

 private:
  NodeProcess node_;
  BooleanField autostart_;
};

}  // namespace

ActionType lifecycle_node_action() {
  std::vector<AttributeSpec> attributes = NodeProcess::attributes(true);
  attributes.push_back({"autostart", AttributeType::kBoolean, false, "false", "configure and activate the node"});
  return {
      .tag = "lifecycle_node",
      .help = "Runs a ROS node with a managed life cycle.",
      .attributes = std::move(attributes),
      .items = NodeProcess::items(),
      .make = [](const Fields& fields) { return std::make_shared<LifecycleNode>(fields); },
  };
}

}  // namespace launch
