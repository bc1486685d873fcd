// SPDX-License-Identifier: Apache-2.0
// Runs a command to its end, or for so long. For threads that may wait.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

namespace launch {

struct TimedCommand {
  bool started = false;  // false: there is no such program
  bool in_time = false;  // false: it was killed
  int exit_code = -1;    // -1: killed by a signal
};

// argv[0] is searched on PATH. Standard output and error go to `output`, a file that is made, or to /dev/null for "".
// The command is killed, with its process group, when the time is over or `hurry` becomes true.
TimedCommand run_timed(const std::vector<std::string>& argv, const std::string& output, std::chrono::milliseconds limit,
                       const std::atomic<bool>* hurry = nullptr);

}  // namespace launch
