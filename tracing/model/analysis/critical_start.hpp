// SPDX-License-Identifier: Apache-2.0
// The critical path of a start: what the process that was ready last had to wait for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// What the launcher did itself: "load a.launch.xml". Times have one zero in all structs here.
struct LauncherStep {
  std::string what;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

// A process waited for something (`depends_on`).
struct StartCondition {
  std::string process;  // as the launch file calls it: "listener"
  std::string text;     // "'talker' has started"
  std::int64_t held_ns = 0;
};

struct StartedProcess {
  StartResult start;
  std::string name;  // as the launch file calls it: "talker"
};

// Nullopt when no process was ready.
std::optional<StartupResult> critical_start(const std::vector<StartedProcess>& processes,
                                            const std::vector<StartCondition>& conditions,
                                            const std::vector<LauncherStep>& steps);

}  // namespace tracing
