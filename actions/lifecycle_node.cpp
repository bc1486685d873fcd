// <lifecycle_node …>: runs a ROS node with a managed life cycle.
#include "actions/node_process.hpp"

namespace launch {

namespace {

class LifecycleNode : public Action {
 public:
  explicit LifecycleNode(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        node_(fields),
        autostart_(fields.boolean("autostart", false)),
        autostart_where_(fields.where("autostart")) {}

 protected:
  void execute(LaunchContext& context) const override {
    if (autostart_.perform(context.scope())) {
      context.cannot_run("autostart can't be carried out: this launcher can't call the node's services",
                         autostart_where_, "leave it out, and run: ros2 lifecycle set NODE configure, then activate");
    }
    node_.request(context);
  }

 private:
  NodeProcess node_;
  BooleanField autostart_;
  SourceRange autostart_where_;
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
