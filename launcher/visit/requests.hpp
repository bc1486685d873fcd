// SPDX-License-Identifier: Apache-2.0
// The requests of visited actions. They are plain data: nothing has happened yet.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/action.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/composable_node.hpp"
#include "launcher/visit/coroutine_request.hpp"
#include "launcher/visit/dependency.hpp"
#include "launcher/visit/event_handler.hpp"
#include "launcher/visit/fault_request.hpp"
#include "launcher/visit/launch_record.hpp"
#include "launcher/visit/left_to_run.hpp"
#include "launcher/visit/process_command.hpp"
#include "launcher/visit/run_scope.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

struct TimerRequest {
  Duration period{0};
  bool cancel_on_shutdown = true;
  std::vector<ActionPtr> actions;
  Scope scope;  // the scope at the place of the timer
};

struct ShutdownRequest {
  std::string reason;
};

// The ROS node that a process will be; a part is empty when the launch file leaves it to the program.
struct NodeDescription {
  std::size_t process = 0;  // index in the processes
  std::optional<std::string> package;
  std::string executable;
  std::optional<std::string> name;
  std::optional<std::string> name_space;
};

// Event handlers to forget.
struct UnregisterRequest {
  std::string name;  // of the handlers
  SourceRange where;
};

// The requests of one traversal. Scopes begin before its processes start.
struct Requests {
  std::vector<std::unique_ptr<RunScope>> scopes;
  std::vector<ProcessSpec> processes;
  std::vector<NodeDescription> nodes;
  std::vector<Dependency> dependencies;         // of the processes
  std::vector<EventHandler> handlers;           // registered before the processes start
  std::vector<UnregisterRequest> unregistered;  // before the new handlers are registered
  std::vector<ProcessCommand> commands;         // for processes that ran before
  std::vector<CoroutineRequest> coroutines;
  std::vector<LoadRequest> loads;
  std::vector<TransitionRequest> transitions;
  std::vector<TimerRequest> timers;
  std::optional<ShutdownRequest> shutdown;
  std::vector<TestRequest> tests;            // only if the visit takes tests (launch_context.hpp)
  std::vector<FaultRequest> faults;          // of the test whose actions are being visited; it takes them
  std::vector<std::string> logs;             // messages of `log` actions
  std::vector<std::string> python_includes;  // paths of Python launch files, which are only noted
  int includes = 0;                          // other launch files that were included
  std::vector<LeftToRun> left_to_run;        // in a plan: what only a run can tell
  std::vector<LaunchRecord> records;         // the steps of the visit

  // Whether nothing is to be carried out.
  bool empty() const;
};

}  // namespace launch
