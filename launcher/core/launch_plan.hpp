// What a launch would do, found by visiting it without carrying anything out.
#pragma once

#include <memory>
#include <vector>

#include "launcher/core/launch_context.hpp"

namespace launch {

struct LaunchPlan {
  std::vector<std::unique_ptr<RunScope>> scopes;
  std::vector<ProcessSpec> processes;  // in the order of their start
  std::vector<NodeDescription> nodes;  // those of the processes that are ROS nodes
  std::vector<LoadRequest> loads;
  std::vector<TransitionRequest> transitions;
  std::vector<std::string> logs;             // messages of `log` actions
  std::vector<std::string> python_includes;  // Python launch files, which count as empty
  int includes = 0;
  bool shutdown = false;  // a `shutdown` was visited
};

// Visits the description; timers fire without waiting, in the order of their due times. Throws LaunchError.
LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description);

}  // namespace launch
