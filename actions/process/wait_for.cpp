// SPDX-License-Identifier: Apache-2.0
// <wait_for topic="…">: visits its actions once the ROS graph shows something.
#include "actions/values/ros_condition.hpp"

namespace launch {

namespace {

class WaitFor : public Action {
 public:
  explicit WaitFor(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        condition_(fields, RosCondition::subject_of(fields, {})),
        actions_(fields.actions()) {}

  Introspection introspect() const override { return {.children = &actions_, .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    EventHandler handler;
    handler.event = OnceReady{condition_.perform(context)};
    handler.once = true;
    handler.actions = actions_;
    handler.scope = context.scope();
    handler.where = where();
    context.requests().handlers.push_back(std::move(handler));
  }

 private:
  RosCondition condition_;
  std::vector<ActionPtr> actions_;
};

}  // namespace

ActionType wait_for_action() {
  std::vector<AttributeSpec> attributes = RosCondition::attributes();
  attributes.push_back({"condition", AttributeType::kLiteral, false, "present",
                        "with topic: present (it has a publisher) or message (a message has arrived)", true});
  return {.tag = "wait_for",
          .help = "Visits its actions once the ROS graph shows a node, a topic or a service.",
          .attributes = std::move(attributes),
          .items = {},
          .holds_actions = true,
          .extension = true,
          .make = [](const Fields& fields) { return std::make_shared<WaitFor>(fields); }};
}

}  // namespace launch
