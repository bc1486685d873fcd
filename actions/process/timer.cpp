// SPDX-License-Identifier: Apache-2.0
// <timer period="…"> and <ros_timer period="…">: visit actions once, after a delay.
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class TimerAction : public Action {
 public:
  explicit TimerAction(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        period_(*fields.number("period")),
        cancel_on_shutdown_(fields.boolean("cancel_on_shutdown", true)),
        actions_(fields.actions()) {
    period_.require_not_negative();
  }

  Introspection introspect() const override { return {.children = &actions_, .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    const std::chrono::duration<double> period(period_.perform(scope));
    context.requests().timers.push_back(
        {std::chrono::duration_cast<Duration>(period), cancel_on_shutdown_.perform(scope), actions_, scope});
  }

 private:
  NumberField period_;
  BooleanField cancel_on_shutdown_;
  std::vector<ActionPtr> actions_;
};

ActionType timer(std::string tag, std::string help) {
  return {
      .tag = std::move(tag),
      .help = std::move(help),
      .attributes = {{"period", AttributeType::kFloat, true, "", "delay in seconds"},
                     {"cancel_on_shutdown", AttributeType::kBoolean, false, "true",
                      "false: a shutdown waits until the timer has fired"}},
      .items = {},
      .holds_actions = true,
      .make = [](const Fields& fields) { return std::make_shared<TimerAction>(fields); },
  };
}

}  // namespace

ActionType timer_action() {
  return timer("timer", "Visits its actions once, a while after the system has started.");
}

// The launcher is no ROS node and receives no /clock, so ROS time is the system's time here.
ActionType ros_timer_action() {
  return timer("ros_timer", "Like timer: this launcher counts system time, never simulated time.");
}

}  // namespace launch
