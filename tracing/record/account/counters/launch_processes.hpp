// SPDX-License-Identifier: Apache-2.0
// Which processes belong to a launch. A session records all processes of the session daemon, also those of others.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"

namespace tracing {

// Notes processes in the directory of the counters. Does nothing for "". Any thread.
void note_launch_processes(const std::string& counters, const std::vector<pid_t>& processes);

// This process, which is the launcher, with all that it has started by now, and those that have started it, as far as
// /proc tells.
std::vector<pid_t> related_processes();

// Those that were noted, and those that count their events there, which the processes of a launch inherit. Sorted, each
// once. Empty: nothing was noted, so nobody knows.
std::vector<std::int64_t> read_launch_processes(const std::string& counters, const std::vector<EventCounts>& counts);

}  // namespace tracing
