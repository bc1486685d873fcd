// SPDX-License-Identifier: Apache-2.0
// An event handler of a launch file: the event that it waits for, and the actions to visit then.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/output_pattern.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/substitution/scope.hpp"
#include "tracing/model/conditions/live_condition.hpp"

namespace launch {

struct OnProcessStart {};
struct OnProcessExit {
  ExitCodeFilter exit_code;
};
struct OnProcessIo {
  OutputPattern pattern;
};
// The health of a process has become this one; nullopt: another one.
struct OnHealthChange {
  std::optional<Health> health;
};
// A process has reached its limit of starts.
struct OnStartLimit {};
// The connection to a machine is lost; empty: to any.
struct OnMachineLost {
  std::string machine;
};
// There is a connection to a machine again; empty: to any.
struct OnMachineBack {
  std::string machine;
};
// Processes that the handler starts run before the others are asked to end.
struct OnShutdown {
  Duration timeout = std::chrono::seconds(5);  // the longest time that they may take
};
// A node with a managed life cycle has gone from one state to another; empty: any.
struct OnStateTransition {
  std::string node;  // its full name
  std::string start_state;
  std::string goal_state;
};
// What nodes do, or don't do any more.
struct OnCondition {
  tracing::LiveCondition condition;
  Duration cool_down{0};  // the least time between two visits
};
// Something outside the launch. The handler is visited once.
struct OnceReady {
  std::shared_ptr<ReadinessCondition> condition;
};

struct EventHandler {
  std::variant<OnProcessStart, OnProcessExit, OnProcessIo, OnHealthChange, OnStartLimit, OnMachineLost, OnMachineBack,
               OnShutdown, OnStateTransition, OnCondition, OnceReady>
      event;
  std::string name;     // the name for unregister_event_handler; empty: none
  std::string process;  // a name (process_table.hpp); empty: every process
  bool once = false;
  std::vector<ActionPtr> actions;
  Scope scope;              // the scope at the place of the handler
  bool live = false;        // its actions are visited in the scope of the whole launch, which they may change
  bool by_handler = false;  // another event handler has asked for it
  SourceRange where;
};

// "on_process_exit of 'talker' with exit code 0", for --dry-run and messages.
std::string describe(const EventHandler& handler);

using EventValues = std::vector<std::pair<std::string, std::string>>;

// "topic", "for", "process" and the like.
EventValues values_of(const OnCondition& wanted, const tracing::ConditionChange& change);

// A handler and the event that it should handle. The values belong in its scope, where $(var event.NAME) reads them.
struct Invocation {
  std::shared_ptr<const EventHandler> handler;
  EventValues values;

  // The handler's scope with the values in it.
  Scope scope() const { return with_values(handler->scope, values); }
  static Scope with_values(Scope scope, const EventValues& values);
};

}  // namespace launch
