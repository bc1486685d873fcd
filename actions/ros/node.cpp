// SPDX-License-Identifier: Apache-2.0
// <node pkg="…" exec="…"/>: runs a ROS node: a program that understands --ros-args.
#include "actions/ros/node_process.hpp"

namespace launch {

namespace {

class Node : public Action {
 public:
  explicit Node(const Fields& fields) : Action(fields.where(), fields.condition()), node_(fields) {}

 protected:
  void execute(LaunchContext& context) const override { node_.request(context); }

 private:
  NodeProcess node_;
};

}  // namespace

ActionType node_action() {
  return {
      .tag = "node",
      .help = "Runs a ROS node.",
      .attributes = NodeProcess::attributes(false),
      .items = NodeProcess::items(),
      .make = [](const Fields& fields) { return std::make_shared<Node>(fields); },
  };
}

}  // namespace launch
