// SPDX-License-Identifier: Apache-2.0
// What a process uses of the machine.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace launch {

struct ProcessUsage {
  double cpu = 0;            // seconds of processor time of all its threads
  std::uint64_t memory = 0;  // bytes that are resident, shared ones included
  bool stopped = false;      // by a signal or a debugger
};

// Nothing when the process has gone.
std::optional<ProcessUsage> read_process_usage(pid_t pid);

}  // namespace launch
