// SPDX-License-Identifier: Apache-2.0
// Scheduling and limits of one process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace launch {

struct ResourceLimits {
  std::optional<int> niceness;              // -20 … 19
  std::optional<int> policy;                // SCHED_OTHER, SCHED_BATCH, SCHED_IDLE, SCHED_FIFO, SCHED_RR
  int priority = 0;                         // 1 … 99 with SCHED_FIFO and SCHED_RR
  std::vector<int> cpus;                    // that it may run on; empty: all those of the launcher
  std::optional<std::uint64_t> memory;      // bytes of private memory (RLIMIT_DATA)
  std::optional<std::uint64_t> open_files;  // descriptors (RLIMIT_NOFILE)
  bool core_files = false;                  // of any size that the hard limit allows (RLIMIT_CORE)

  bool any() const { return niceness || policy || !cpus.empty() || memory || open_files || core_files; }
};

// "nice -5", "policy fifo 80", "cpus 0,2-3", "memory 1048576 bytes", "64 open files", "core
// files": for --dry-run.
std::vector<std::string> describe(const ResourceLimits& limits);

// "other", "batch", "idle", "fifo", "rr", by the number of the policy, and back (nothing for another word).
std::string scheduling_policy_name(int policy);
std::optional<int> scheduling_policy(const std::string& name);

// "0,2-3".
std::string cpu_list(const std::vector<int>& cpus);

// The arguments of launch-exec up to the one that names the program. The program launch-exec applies the limits to
// itself before it becomes the program of the process.
std::vector<std::string> launch_exec_arguments(const ResourceLimits& limits);

// The message for the user when a limit could not be applied. `step` is launch-exec's (exec/launch_exec_protocol.hpp).
std::string limit_failure(char step, int error, const ResourceLimits& limits);

}  // namespace launch
