// SPDX-License-Identifier: Apache-2.0
// Short names of what has results, as people read them.
#pragma once

#include <string>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// What calls it: "timer 100 ms", "subscription /pong", "client of /add", "callback 0x7f…"
std::string source_label(const CallbackResult& callback);

// "/ping, timer 100 ms"
std::string callback_label(const CallbackResult& callback);

// "/source -> /filter -> /drain", "/source -> 5 more -> /drain", "reaction: /source -> /drain" for one with a name
std::string chain_label(const ChainResult& chain);

// "ping [71]", "ping [71], thread 74" for a thread that is not the main one. A process with one node is called after
// it, because the names of processes are cut after 15 characters.
std::string executor_label(const ExecutorResult& executor, const TraceResults& results);

// "ping [71]"
std::string process_label(const ProcessResult& process);

}  // namespace tracing
