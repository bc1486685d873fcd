// SPDX-License-Identifier: Apache-2.0
// An event of a launch file: what it waits for and what is visited then.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/output_pattern.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct OnProcessStart {};
struct OnProcessExit {
  ExitCodeFilter exit_code;
};
struct OnProcessIo {
  OutputPattern pattern;
};
// Processes that it starts run before the others are asked to end.
struct OnShutdown {
  Duration timeout{0};  // at most so long
};
// A node with a managed life cycle has gone from one state to another; empty: any.
struct OnStateTransition {
  std::string node;  // its full name
  std::string start_state;
  std::string goal_state;
};
// Something outside of the launch. Its handler is visited once.
struct OnceReady {
  std::shared_ptr<ReadinessCondition> condition;
};

struct EventHandler {
  std::variant<OnProcessStart, OnProcessExit, OnProcessIo, OnShutdown, OnStateTransition, OnceReady> event;
  std::string name;     // by which unregister_event_handler means it; empty: not at all
  std::string process;  // a name (process_table.hpp); empty: every process
  bool once = false;
  std::vector<ActionPtr> actions;
  Scope scope;  // as it was where the handler stands
  SourceRange where;
};

// "on_process_exit of 'talker' with exit code 0", for --dry-run and messages.
std::string describe(const EventHandler& handler);

using EventValues = std::vector<std::pair<std::string, std::string>>;

// A handler and the event that it shall handle. The values are for its scope: what $(var event.NAME) reads.
struct Invocation {
  std::shared_ptr<const EventHandler> handler;
  EventValues values;

  // The handler's scope with the values in it.
  Scope scope() const;
};

}  // namespace launch
