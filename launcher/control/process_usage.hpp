// SPDX-License-Identifier: Apache-2.0
// What processes use of the machine, asked by those who want to know it: the launcher itself never does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace launch {

struct ProcessUsage {
  double cpu = 0;            // seconds of processor time of all its threads
  std::uint64_t memory = 0;  // bytes that are resident, shared ones included
};

// Nothing when the process has gone.
std::optional<ProcessUsage> read_process_usage(pid_t pid);
// Of several processes, in their order. Many are divided among threads, because the kernel takes microseconds for each.
std::vector<std::optional<ProcessUsage>> read_process_usage(const std::vector<pid_t>& pids);

}  // namespace launch
