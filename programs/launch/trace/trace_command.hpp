// SPDX-License-Identifier: Apache-2.0
// `launch trace`: tracing from the command line, as `ros2 trace` does it.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/session/tracer.hpp"

namespace tracing {

// `arguments` follow `launch trace` on the command line. Without a verb the interactive form runs: it asks for Enter on
// stdin, once to start and once to stop. Blocks. Returns the exit code: 0; 1 when a session could not be controlled
// (the reason is on stderr); 2 for wrong usage or when LTTng is not installed. Call it before the program has threads:
// it takes SIGINT and SIGTERM for itself.
int run_trace_command(const std::vector<std::string>& arguments);

// With a tracer of the caller.
int run_trace_command(const std::vector<std::string>& arguments, Tracer& tracer);

// What the shells offer on the command line of `launch trace`.
// Candidates for the last of the words after `launch trace`: verbs, options, names of sessions, of events that can be
// recorded now, and of context fields. They are sorted. The beginning of the last word does not filter them yet. The
// function starts no session daemon. Without a daemon it knows only the events of ROS 2.
std::vector<std::string> trace_completions(const std::vector<std::string>& words);

}  // namespace tracing
