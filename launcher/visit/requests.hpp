// SPDX-License-Identifier: Apache-2.0
// What the visit of a launch file asks for. Requests are plain data: nothing has happened yet.
//
// A kind of request is a struct and a list in Requests. Whoever deals with requests shows them to a visitor that has a
// case for each kind: the run, the farewell and its check, the plan, the outputs of --dry-run, the graph, the findings.
// A new kind does not compile until each of them says what becomes of it (CONTRIBUTING.md, "How to add a kind of
// request").
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/action.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/composable_node.hpp"
#include "launcher/visit/dependency.hpp"
#include "launcher/visit/event_handler.hpp"
#include "launcher/visit/fault_request.hpp"
#include "launcher/visit/launch_record.hpp"
#include "launcher/visit/left_to_run.hpp"
#include "launcher/visit/process_command.hpp"
#include "launcher/visit/run_scope.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

class PythonFile;

using RunScopePtr = std::unique_ptr<RunScope>;

struct TimerRequest {
  Duration period{0};
  bool cancel_on_shutdown = true;
  std::vector<ActionPtr> actions;
  Scope scope;              // the scope at the place of the timer
  bool by_handler = false;  // an event handler has asked for it, or a timer of one
};

struct ShutdownRequest {
  std::string reason = "reason not given";
  SourceRange where{};
};

// The ROS node that a process will be; a part is empty when the launch file leaves it to the program.
struct NodeDescription {
  std::size_t process = 0;  // index in the processes
  std::optional<std::string> package;
  std::string executable;
  std::optional<std::string> name;
  std::optional<std::string> name_space;
  std::vector<NamedParameter> parameters{};  // that the launch file gives by name, in order
  std::vector<std::size_t> value_files{};    // which generated files of the process hold nothing else
};

// Event handlers to forget.
struct UnregisterRequest {
  std::string name;  // of the handlers
  SourceRange where;
};

// A visited OpaqueCoroutine of a Python launch file. It should run beside the processes.
struct CoroutineRequest {
  python::ObjectPtr object;
  std::shared_ptr<PythonFile> file;
  SourceRange where;
};

// The requests of one traversal.
struct Requests {
  // The kinds, in the order in which a run carries them out.
  std::vector<RunScopePtr> scopes;
  std::vector<ProcessCommand> commands;         // for processes that ran before
  std::vector<UnregisterRequest> unregistered;  // before the new handlers are registered
  std::vector<TestRequest> tests;               // only if the visit takes tests (launch_context.hpp)
  std::vector<EventHandler> handlers;           // registered before the processes start
  std::vector<TimerRequest> timers;
  std::vector<LoadRequest> loads;  // before the processes: a container that can't start drops what waits for it
  std::vector<TransitionRequest> transitions;
  std::vector<ProcessSpec> processes;
  std::vector<CoroutineRequest> coroutines;
  std::vector<ShutdownRequest> shutdowns;  // the last one counts
  std::vector<NodeDescription> nodes;      // of the processes
  std::vector<Dependency> dependencies;    // of the processes

  // Notes of the visit, with which nothing is to be done.
  std::vector<FaultRequest> faults;          // of the test whose actions are being visited; it takes them
  std::vector<std::string> logs;             // messages of `log` actions
  std::vector<std::string> python_includes;  // paths of Python launch files, which are only noted
  int includes = 0;                          // other launch files that were included
  std::vector<LeftToRun> left_to_run;        // in a plan: what only a run can tell
  std::vector<LaunchRecord> records;         // the steps of the visit

  std::size_t count() const;
  // Whether nothing is to be carried out.
  bool empty() const { return count() == 0; }
};

// Shows each list to the visitor, also an empty one, in the order above. The visitor is an Overloaded without a case
// for "anything else". For a LaunchPlan, call it with a reference to its Requests.
template <typename ConstOrNot, typename Visitor>
void for_each_kind(ConstOrNot& requests, const Visitor& visit) {
  // A new kind must stand here as well, else this does not compile.
  auto& [scopes, commands, unregistered, tests, handlers, timers, loads, transitions, processes, coroutines, shutdowns,
         nodes, dependencies, faults, logs, python_includes, includes, left_to_run, records] = requests;
  visit(scopes);
  visit(commands);
  visit(unregistered);
  visit(tests);
  visit(handlers);
  visit(timers);
  visit(loads);
  visit(transitions);
  visit(processes);
  visit(coroutines);
  visit(shutdowns);
  visit(nodes);
  visit(dependencies);
}

// The case of a visitor for the kinds with which it does nothing.
template <typename... Kinds>
struct PassOver {
  template <typename Kind>
    requires(std::is_same_v<Kind, Kinds> || ...)
  void operator()(const Kind&) const {}
};

// Shows each request to the visitor, kind by kind.
template <typename Visitor>
void for_each_request(const Requests& requests, const Visitor& visit) {
  for_each_kind(requests, [&](const auto& kind) {
    for (const auto& request : kind) {
      visit(request);
    }
  });
}
template <typename Visitor>
void for_each_request(Requests& requests, const Visitor& visit) {
  for_each_kind(requests, [&](auto& kind) {
    for (auto& request : kind) {
      visit(request);
    }
  });
}

// Checks the requests of on_shutdown handlers: only some of them can still be carried out. Throws LaunchError for a
// trace, which could not begin any more, for requests to the services of nodes, and for processes that wait for others.
// `may_ask_nodes`: requests to the services of nodes are no error, they are left out.
void check_farewell(const Requests& requests, bool may_ask_nodes);

// Conditions on what nodes do need a trace. `is_recorded`: the launch has one. Throws LaunchError.
void check_conditions(const std::vector<EventHandler>& handlers, bool is_recorded);

}  // namespace launch
