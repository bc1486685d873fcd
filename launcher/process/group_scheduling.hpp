// SPDX-License-Identifier: Apache-2.0
// How the threads of a process that runs get processors: changed for all of them, and given back.
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/exec/scheduling_attributes.hpp"
#include "launcher/process/resource_limits.hpp"

namespace launch {

struct ThreadScheduling {
  SchedulingAttributes attributes{};
  cpu_set_t cpus{};
};

struct SchedulingParts {
  bool niceness = false;
  bool policy = false;  // with its priority
  bool cpus = false;
};

// What the threads of a process and of its group had before the first change. A thread that was not there then has got
// what it has from the one that has started it; it gets back what the main thread had.
struct GroupScheduling {
  pid_t main_thread = 0;
  std::map<pid_t, ThreadScheduling> threads = {};
  bool has_all = false;          // false: at most those for which the kernel has refused to put something back
  SchedulingParts changed = {};  // since then; nothing else is given back
  ThreadScheduling last = {};    // the values of these parts now, but for threads that have changed them themselves
};

// What the kernel has refused.
struct SchedulingFailure {
  char step = 0;  // of launch_exec_protocol.hpp; 0: to give back what there was
  int error = 0;
  bool leaves_changes = false;  // it has also refused to put back what was changed before
};

// `processes` gives those of the group now: it is asked until there is no thread that was not there before.
using ProcessesOfGroup = std::function<std::vector<pid_t>()>;

// Changes the niceness, the policy with its priority and the CPUs of all threads, as far as `wanted` says them.
// `before` gets what each one had, unless there was a change before. If the kernel refuses one of them, those that were
// changed now are put back. Those for which it refuses that, too, are in `before`.
std::optional<SchedulingFailure> change_scheduling(const ProcessesOfGroup& processes, const ResourceLimits& wanted,
                                                   GroupScheduling& before);
// Gives back the parts that were changed. A thread that has changed one of them itself meanwhile keeps it.
std::optional<SchedulingFailure> restore_scheduling(const ProcessesOfGroup& processes, const GroupScheduling& before);

// For people: "cannot set the niceness -5 (…): Operation not permitted".
std::string failure_text(const SchedulingFailure& failure, const ResourceLimits& wanted);

}  // namespace launch
