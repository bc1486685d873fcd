// SPDX-License-Identifier: Apache-2.0
// What the shells offer on the command line of `launch trace`.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// Candidates for the last of the words after `launch trace`, which is perhaps empty or begun: verbs, options, names of
// sessions, of events that can be recorded now, and of context fields. Sorted; not yet narrowed to what is begun.
// Starts no session daemon; without one it knows the events of ROS 2 alone.
std::vector<std::string> trace_completions(const std::vector<std::string>& words);

}  // namespace tracing
