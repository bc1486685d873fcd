// SPDX-License-Identifier: Apache-2.0
// Changes of a twin, as a person writes them:
//
//   executor=/planner:multi:4     the executor that runs the node: single, multi (with threads) or events
//   groups=/planner:separate      the callback groups of the node: one, separate or reentrant
//   cpus=4                        processors of the machine
//   priority=/planner:50          SCHED_FIFO with this priority; other: an ordinary process
//   rate=/camera:20Hz             the rate of the node's timers; rate(/camera)*2: times a factor
//   duration=/mapper:5ms          the time of the node's callbacks; duration(/mapper)*0.5: times a factor
//
// Several are separated by commas. `*` in a node's name stands for any text.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

// Changes the system. Throws launch::LaunchError, which points into the text, if the text has a mistake or names
// something that the system does not have.
void apply_what_if(const std::string& text, System& system);

}  // namespace tracing::twin
