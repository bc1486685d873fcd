// SPDX-License-Identifier: Apache-2.0
// <on_process_start>, <on_process_exit>, <on_process_io>, <on_health_change>, <on_start_limit>, <on_machine_lost>,
// <on_machine_back>, <on_shutdown>, <on_state_transition>, <wait_for>: visit actions when something happens.
// <unregister_event_handler>: a handler gets no more events.
#include <fmt/format.h>

#include <algorithm>

#include "actions/process/handler_action.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

using Type = AttributeType;

void check_pattern(const Fields& fields) {
  const auto is_known = [&](const char* attribute) {
    return !fields.has(attribute) || fields.text(attribute).is_literal();
  };
  if (Scope nothing; is_known("pattern") && is_known("stream")) {
    perform_output_pattern(fields, nothing);
  }
}

// The states that a node stays in, and the states that it passes through.
const std::vector<std::string> kStates = {"unconfigured", "inactive",       "active",     "finalized",
                                          "configuring",  "cleaningup",     "activating", "deactivating",
                                          "shuttingdown", "errorprocessing"};

Setting<Handled<OnStateTransition>> state_row(const char* name, const char* help,
                                              std::string OnStateTransition::*member) {
  return {.attribute = {name, Type::kText, false, "any", help},
          .perform =
              [name, member](const Fields& fields, Scope& scope, Handled<OnStateTransition>& handled) {
                const Template& given = fields.text(name);
                std::string state = given.perform(scope);
                if (std::find(kStates.begin(), kStates.end(), state) == kStates.end()) {
                  throw LaunchError(fmt::format("a node with a managed life cycle has no state '{}'", state),
                                    given.where(), did_you_mean(state, kStates));
                }
                handled.event.*member = std::move(state);
              },
          .checks_literal = true};
}

}  // namespace

ActionType on_process_start_action() {
  using Event = OnProcessStart;
  return handler_of<Event>("on_process_start", "Visits its actions each time a process has started.",
                           {process_row<Event>(), once_row<Event>(), handler_name_row<Event>()});
}

ActionType on_process_exit_action() {
  using Event = OnProcessExit;
  return handler_of<Event>(
      "on_process_exit",
      "Visits its actions each time a process has ended; a process that can't be started counts as ended "
      "with exit code 127.",
      {process_row<Event>(),
       {.attribute = {"exit_code", Type::kText, false, "any",
                      "any, nonzero, or codes and signals (-9 or SIGKILL) separated by commas"},
        .perform =
            [](const Fields& fields, Scope& scope, Handled<Event>& handled) {
              const Template& text = fields.text("exit_code");
              handled.event.exit_code = ExitCodeFilter(text.perform(scope), text.where());
            },
        .checks_literal = true},
       once_row<Event>(),
       handler_name_row<Event>()});
}

ActionType on_process_io_action() {
  using Event = OnProcessIo;
  return handler_of<Event>(
      "on_process_io", "Visits its actions for each line that a process has written.",
      {process_row<Event>(),
       {.attribute = {"pattern", Type::kText, false, "every line", "regular expression to be found in the line"}},
       {.attribute = {"stream", Type::kText, false, "both", "stdout, stderr or both"}},
       once_row<Event>(),
       handler_name_row<Event>()},
      check_pattern, [](const Fields& fields, LaunchContext& context, Handled<Event>& handled) {
        handled.event.pattern = perform_output_pattern(fields, context.scope());
      });
}

ActionType on_health_change_action() {
  using Event = OnHealthChange;
  return handler_of<Event>(
      "on_health_change", "Visits its actions each time the health of a watched process has changed.",
      {process_row<Event>(),
       {.attribute = {"to", Type::kText, false, "any", "healthy or unhealthy"},
        .perform =
            [](const Fields& fields, Scope& scope, Handled<Event>& handled) {
              const Template& text = fields.text("to");
              const std::string to = text.perform(scope);
              if (to != "healthy" && to != "unhealthy") {
                throw LaunchError(fmt::format("the health of a process gets healthy or unhealthy, not '{}'", to),
                                  text.where(), did_you_mean(to, {"healthy", "unhealthy"}));
              }
              handled.event.health = to == "healthy" ? Health::kHealthy : Health::kUnhealthy;
            },
        .checks_literal = true},
       once_row<Event>(),
       handler_name_row<Event>()});
}

ActionType on_start_limit_action() {
  using Event = OnStartLimit;
  return handler_of<Event>("on_start_limit",
                           "Visits its actions when a process has been started as often as its start_limit allows.",
                           {process_row<Event>(), once_row<Event>(), handler_name_row<Event>()});
}

namespace {

template <typename Event>
ActionType of_machine(const char* tag, const char* help) {
  return handler_of<Event>(
      tag, help,
      {{.attribute = {"machine", Type::kText, false, "every machine", "name of the machine"},
        .perform =
            [](const Fields& fields, Scope& scope, Handled<Event>& handled) {
              const Template& text = fields.text("machine");
              handled.event.machine = text.perform(scope);
              if (handled.event.machine.empty() || handled.event.machine == kLocalMachine) {
                throw LaunchError(handled.event.machine.empty() ? "the name of the machine is empty"
                                                                : "there is no connection to this machine",
                                  text.where(), "leave the attribute out to mean every other machine");
              }
            },
        .checks_literal = true},
       once_row<Event>(),
       handler_name_row<Event>()},
      nullptr, [](const Fields& fields, LaunchContext& context, Handled<Event>& handled) {
        if (fields.has("machine")) {
          context.machines().require_declared(handled.event.machine, fields.text("machine").where());
        }
      });
}

}  // namespace

ActionType on_machine_lost_action() {
  return of_machine<OnMachineLost>("on_machine_lost",
                                   "Visits its actions when the connection to another machine is lost.");
}

ActionType on_machine_back_action() {
  return of_machine<OnMachineBack>(
      "on_machine_back", "Visits its actions when a connection to another machine that was lost is made again.");
}

ActionType on_shutdown_action() {
  using Event = OnShutdown;
  return handler_of<Event>(
      "on_shutdown",
      "Visits its actions when the system is about to end; processes that they start run before the others "
      "are asked to end.",
      {{.attribute = {"timeout", Type::kFloat, false, "5", "seconds that these processes may take"},
        .place = place_of(&Handled<Event>::event, &Event::timeout)},
       handler_name_row<Event>()});
}

ActionType on_state_transition_action() {
  using Event = OnStateTransition;
  return handler_of<Event>(
      "on_state_transition", "Visits its actions each time a node with a managed life cycle has changed its state.",
      {{.attribute = {"node", Type::kText, true, "",
                      "the node, of this launch or not; a relative name is below the namespace of the scope"},
        .perform = [](const Fields& fields, Scope& scope,
                      Handled<Event>& handled) { handled.event.node = resolve_name(fields.text("node"), scope); }},
       state_row("start_state", "the state that the node has left", &Event::start_state),
       state_row("goal_state", "the state that the node has reached", &Event::goal_state),
       once_row<Event>(),
       handler_name_row<Event>()});
}

ActionType wait_for_action() {
  HandlerRows<OnceReady> rows;
  for (AttributeSpec& attribute : ros_condition_attributes()) {
    rows.push_back({.attribute = std::move(attribute)});
  }
  rows.push_back({.attribute = {"condition", Type::kLiteral, false, "present",
                                "with topic: present (it has a publisher) or message (a message has arrived)"}});
  return handler_of<OnceReady>(
      "wait_for", "Visits its actions once the ROS graph shows a node, a topic or a service.", std::move(rows),
      [](const Fields& fields) { check_ros_condition(fields, ros_subject_of(fields)); },
      [](const Fields& fields, LaunchContext& context, Handled<OnceReady>& handled) {
        handled.event.condition = perform_ros_condition(fields, ros_subject_of(fields), context);
        handled.handler.once = true;
      });
}

ActionType unregister_event_handler_action() {
  return action_of<UnregisterRequest>(
      {.tag = "unregister_event_handler",
       .help = "Removes the event handlers of a name; the processes that they started run on.",
       .extension = true},
      {{.attribute = {"name", Type::kText, true, "", "name of the handlers", true},
        .place = place_of(&UnregisterRequest::name)}},
      [](const Fields& fields, LaunchContext& context, UnregisterRequest& request) {
        request.where = fields.text("name").where();
        // A handler of the same traversal is not registered yet.
        const auto is_meant = [&](const EventHandler& handler) { return handler.name == request.name; };
        if (std::erase_if(context.requests().handlers, is_meant) == 0) {
          context.requests().unregistered.push_back(std::move(request));
        }
      });
}

}  // namespace launch
