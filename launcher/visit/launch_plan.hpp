// SPDX-License-Identifier: Apache-2.0
// What a launch would do. A visit finds it, and nothing is carried out.
#pragma once

#include <memory>
#include <vector>

#include "launcher/visit/launch_context.hpp"

namespace launch {

struct PlannedHandler;

struct LaunchPlan {
  std::vector<std::unique_ptr<RunScope>> scopes;
  std::vector<ProcessSpec> processes;    // in the order of their start
  std::vector<NodeDescription> nodes;    // the nodes among the processes
  std::vector<Dependency> dependencies;  // of the processes
  std::vector<PlannedHandler> handlers;
  std::vector<Duration> delays;  // of each process: when the timer that starts it fires; 0 without a timer
  std::vector<ProcessCommand> commands;
  std::vector<LoadRequest> loads;
  std::vector<TransitionRequest> transitions;
  std::vector<CoroutineRequest> coroutines;  // of Python launch files
  std::vector<TestRequest> tests;
  std::vector<std::string> logs;             // messages of `log` actions
  std::vector<std::string> python_includes;  // Python launch files, which count as empty
  std::vector<LeftToRun> left_to_run;        // depends on functions that only a run calls
  int includes = 0;
  bool shutdown = false;  // a `shutdown` was visited
};

// An event handler and what it would do. A made-up event gives the values of $(var event.…).
struct PlannedHandler {
  EventHandler handler;
  LaunchPlan plan;
};

// Visits the description; timers fire without waiting, in the order of their due times, and after them every event
// handler. Functions of the launch file that timers and handlers would call are not called: `left_to_run` names them.
// Throws LaunchError.
LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description);

}  // namespace launch
