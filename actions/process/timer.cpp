// SPDX-License-Identifier: Apache-2.0
// <timer period="…"> and <ros_timer period="…">: visit actions once, after a delay.
#include "actions/row_action.hpp"

namespace launch {

namespace {

ActionType timer(std::string tag, std::string help) {
  return action_of<TimerRequest>({.tag = std::move(tag), .help = std::move(help), .holds_actions = true},
                                 {{.attribute = {"period", AttributeType::kFloat, true, "", "delay in seconds"},
                                   .place = place_of(&TimerRequest::period)},
                                  {.attribute = {"cancel_on_shutdown", AttributeType::kBoolean, false, "true",
                                                 "false: a shutdown waits until the timer has fired"},
                                   .place = place_of(&TimerRequest::cancel_on_shutdown)}},
                                 [](const Fields& fields, LaunchContext& context, TimerRequest& timer) {
                                   timer.actions = fields.actions();
                                   timer.scope = context.scope();
                                   context.requests().timers.push_back(std::move(timer));
                                 });
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
