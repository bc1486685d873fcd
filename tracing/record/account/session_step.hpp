// SPDX-License-Identifier: Apache-2.0
// Where the time of a set-up or an end goes.
#pragma once

#include <chrono>
#include <string>

namespace tracing {

// How long a step of the set-up or of the end took, for --timing.
struct SessionStep {
  std::string name;  // "session daemon", "create session", "channel ros2", …
  std::chrono::nanoseconds took;
};

}  // namespace tracing
