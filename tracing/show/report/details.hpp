// SPDX-License-Identifier: Apache-2.0
// The sections of the text report that are shown on demand. Each one begins with an empty line, and is empty when it
// has nothing to say.
#pragma once

#include <string>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

// Losses by stream, events by process.
std::string event_details(const Report& report);

// Topics, the ways of their messages, chains, service calls, and what executors served.
std::string message_details(const TraceResults& results);

// The start of each process, and the critical path of the start.
std::string start_details(const TraceResults& results);

// event_details(), message_details(), and every start, callback, lifecycle state and unmatched event.
std::string details(const Report& report);

// The steps of one chain with their times.
std::string chain_details(const ChainResult& chain, const Hosts& hosts);

// What limits the results.
std::string notes(const Report& report);

}  // namespace tracing
