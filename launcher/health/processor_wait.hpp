// SPDX-License-Identifier: Apache-2.0
// How long a thread has waited for a processor. A thread that gets none is not to blame for what it does not do.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <unordered_map>

#include "launcher/process/event_loop.hpp"

namespace launch {

class ProcessorWait {
 public:
  // `proc` is where the kernel tells of processes.
  explicit ProcessorWait(std::string proc = "/proc") : proc_(std::move(proc)) {}

  // How much of the time `passed`, since the last call for this thread, it was ready to run and did not. 0 for the
  // first call, and where the kernel does not tell it.
  Duration of_thread(pid_t pid, pid_t tid, Duration passed);
  // Of the thread of the process that has waited most.
  Duration of_process(pid_t pid, Duration passed);
  void forget() { seen_.clear(); }

 private:
  struct Seen {
    Duration ran;
    Duration waited;
  };

  std::string proc_;
  std::unordered_map<pid_t, Seen> seen_;
};

// The state of a thread, as the letter of /proc/PID/task/TID/stat; '?' if it has gone.
char state_of_thread(pid_t pid, pid_t tid, const std::string& proc = "/proc");

}  // namespace launch
