// SPDX-License-Identifier: Apache-2.0
// What the shells offer on the command line of `launch trace`.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// Candidates for the last of the words after `launch trace`: verbs, options, names of sessions, of events that can be
// recorded now, and of context fields. They are sorted. The beginning of the last word does not filter them yet. The
// function starts no session daemon. Without a daemon it knows only the events of ROS 2.
std::vector<std::string> trace_completions(const std::vector<std::string>& words);

}  // namespace tracing
