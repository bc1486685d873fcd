// SPDX-License-Identifier: Apache-2.0
// Looks at one thing by which it is told whether a process is healthy. A probe is for one watch of one process, over
// all its runs.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"

namespace launch {

struct Look {
  enum class Result {
    kGood,
    kPending,  // nothing is known yet, or it can't be judged
    kBad
  };
  Result result = Result::kPending;
  std::string why{};   // of kBad: "a timer callback has run for 5.1 s"
  std::string note{};  // what a user should know, told once in a run
};

class HealthProbe {
 public:
  virtual ~HealthProbe() = default;

  // A run of the process begins, and ends.
  virtual void begin(pid_t pid) = 0;
  virtual void end() {}

  // `now` is that of the loop. `passed` is the time since the last look that counts: not that in which the machine was
  // suspended or the launcher did not run.
  virtual Look look(Duration now, Duration passed) = 0;

  // A line of the process.
  virtual void on_line(OutputStream, std::string_view) {}
};

}  // namespace launch
