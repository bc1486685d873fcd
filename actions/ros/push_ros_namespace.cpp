// SPDX-License-Identifier: Apache-2.0
// <push_ros_namespace namespace="…"/>: every later node of the scope lives below the namespace.
#include "actions/values/ros_names.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class PushRosNamespace : public Action {
 public:
  explicit PushRosNamespace(const Fields& fields)
      : Action(fields.where(), fields.condition()), namespace_(fields.text("namespace")) {}

 protected:
  void execute(LaunchContext& context) const override { push_namespace(namespace_, context.scope()); }

 private:
  Template namespace_;
};

ActionType push_ros_namespace(std::string tag, std::string help) {
  return {
      .tag = std::move(tag),
      .help = std::move(help),
      .attributes = {{"namespace", AttributeType::kText, true, "",
                      "below the scope's namespace unless it starts with '/'"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<PushRosNamespace>(fields); },
  };
}

}  // namespace

ActionType push_ros_namespace_action() {
  return push_ros_namespace("push_ros_namespace", "Puts every later node of the scope below a namespace.");
}

ActionType push_ros_namespace_alias_action() {
  return push_ros_namespace("push-ros-namespace", "The older name of push_ros_namespace.");
}

}  // namespace launch
