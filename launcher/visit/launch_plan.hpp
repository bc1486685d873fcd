// SPDX-License-Identifier: Apache-2.0
// What a launch would do. A visit finds it, and nothing is carried out.
#pragma once

#include <vector>

#include "launcher/visit/launch_context.hpp"

namespace launch {

// All requests of a launch. Timers are not among them: what they start is.
struct LaunchPlan : Requests {
  std::vector<Duration> delays;  // of each process: when the timer that starts it fires; 0 without a timer
  // What each handler would do. A made-up event gives the values of $(var event.…).
  std::vector<LaunchPlan> reactions;
};

// Whether the processes of a plan are as its scopes, such as a trace, make them.
enum class PlannedScopes { kCarriedOut, kLeftOut };

// Visits the description; timers fire without waiting, in the order of their due times, and after them every event
// handler. Functions of the launch file that timers and handlers would call are not called: `left_to_run` names them.
// Throws LaunchError.
LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description,
                       PlannedScopes scopes = PlannedScopes::kCarriedOut);

}  // namespace launch
