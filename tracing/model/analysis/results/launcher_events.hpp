// SPDX-License-Identifier: Apache-2.0
// What the launcher saw and did while the system ran.
#pragma once

#include <array>

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

struct LauncherEventResult {
  enum class Kind { kCondition, kScheduling, kSignal, kExit, kRespawn, kCut };
  static constexpr std::array<const char*, 6> kKinds{"condition", "scheduling", "signal", "exit", "respawn", "cut"};

  std::int64_t time_ns = 0;
  Kind kind = Kind::kCondition;
  std::string subject;  // a condition, a process or a class of events
  std::string what;
  std::string file;
  std::int64_t line = 0;

  const char* kind_name() const { return kKinds[static_cast<std::size_t>(kind)]; }
  // Signals and exits belong to the end of each launch.
  bool is_ordinary() const { return kind == Kind::kSignal || kind == Kind::kExit; }
  // What happened to the subject: "ended, exit code 1, and is started again".
  std::string sentence() const;

  static const Field<LauncherEventResult> kFields[];
};
inline constexpr Field<LauncherEventResult> LauncherEventResult::kFields[] = {
    {"time_ns", &LauncherEventResult::time_ns, "", trait::kTime},
    {"kind",
     {&LauncherEventResult::kind_name, LauncherEventResult::kKinds},
     "a condition of the launch file that begins to hold or holds no longer; a process whose threads get processors in "
     "another way, or as before; a signal that was sent; a process that ended; one that ended and is started again; "
     "a class of events that was dropped from the trace"},
    {"subject", &LauncherEventResult::subject, "the condition; the process: `talker-1`; the class of events"},
    {"what", &LauncherEventResult::what,
     "`/scan: 3.1 messages a second`, `nice 5, cpus 0`, `SIGINT`, `exit code 1`; `\"\"`: the threads get processors as "
     "before"},
    {"file", &LauncherEventResult::file, "the launch file that asked for it; `\"\"`: none did"},
    {"line", &LauncherEventResult::line, "in this file"},
};

}  // namespace tracing
