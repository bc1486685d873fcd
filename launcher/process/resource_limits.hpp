// SPDX-License-Identifier: Apache-2.0
// Scheduling and limits of one process.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

inline constexpr int kDeadlinePolicy = 6;  // SCHED_DEADLINE, which not all headers have

// Of SCHED_DEADLINE, sched(7): so much time of a processor within the deadline, in each period.
struct DeadlineSchedule {
  std::chrono::nanoseconds runtime{0};
  std::chrono::nanoseconds deadline{0};
  std::chrono::nanoseconds period{0};  // 0: as long as the deadline
};

// RLIMIT_MEMLOCK without a limit.
inline constexpr std::uint64_t kUnlimited = ~std::uint64_t{0};

struct ResourceLimits {
  std::optional<int> niceness;          // -20 … 19
  std::optional<int> policy;            // SCHED_OTHER, SCHED_BATCH, SCHED_IDLE, SCHED_FIFO, SCHED_RR, SCHED_DEADLINE
  int priority = 0;                     // 1 … 99 with SCHED_FIFO and SCHED_RR
  std::vector<int> cpus;                // that it may run on; empty: all those of the launcher
  std::optional<std::uint64_t> memory;  // bytes of private memory (RLIMIT_DATA)
  std::optional<std::uint64_t> open_files;                // descriptors (RLIMIT_NOFILE)
  bool core_files = false;                                // of any size that the hard limit allows (RLIMIT_CORE)
  DeadlineSchedule schedule{};                            // of SCHED_DEADLINE
  std::optional<std::chrono::nanoseconds> timer_slack{};  // by which sleeps may be longer
  std::optional<int> oom_score_adj{};                     // -1000 … 1000 (the kernel's first choice)
  std::optional<std::uint64_t> locked_memory{};           // bytes that it may lock itself (RLIMIT_MEMLOCK)
  std::string control_group{};                            // directory of the cgroup in which it starts; empty: ours

  bool any() const {
    return niceness || policy || !cpus.empty() || memory || open_files || core_files || timer_slack || oom_score_adj ||
           locked_memory || !control_group.empty();
  }
};

// "nice -5", "policy fifo 80", "cpus 0,2-3", "memory 1048576 bytes", "64 open files", "core
// files": for --dry-run.
std::vector<std::string> describe(const ResourceLimits& limits);

// "other", "batch", "idle", "fifo", "rr", "deadline", by the number of the policy, and back (nothing for another word).
std::string scheduling_policy_name(int policy);
std::optional<int> scheduling_policy(const std::string& name);

// Those that this process may run on.
std::vector<int> allowed_cpus();

// "0,2-3".
std::string cpu_list(const std::vector<int>& cpus);
// The other way round: in order, each once. Nothing for a text that is no such list.
std::optional<std::vector<int>> parse_cpu_list(std::string_view text);

// The arguments of launch-exec up to the one that names the program. The program launch-exec applies the limits to
// itself before it becomes the program of the process.
std::vector<std::string> launch_exec_arguments(const ResourceLimits& limits);

// The message for the user when a limit could not be applied. `step` is launch-exec's (exec/launch_exec_protocol.hpp).
std::string limit_failure(char step, int error, const ResourceLimits& limits);

}  // namespace launch
