// SPDX-License-Identifier: Apache-2.0
// Which process how many of a session's lost events are of, and what each process fired.
//
// Buffers for each process: the packets say it. Buffers that processes share: a process counts what it hands to LTTng
// (event_counters.hpp), the trace says what arrived, and the rest is lost. What LTTng counts for the channels is the
// check: where the sums agree the account is exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tracing/account/event_counters.hpp"
#include "tracing/account/loss_account.hpp"
#include "tracing/account/packet_index.hpp"
#include "tracing/account/process_account.hpp"
#include "tracing/account/recorded_events.hpp"

namespace tracing {

// What a trace holds of one process.
struct RecordedProcess {
  std::vector<std::string> nodes;               // fully qualified
  std::map<std::string, std::uint64_t> events;  // by name
};
using RecordedProcesses = std::map<std::int64_t, RecordedProcess>;  // by process id

// As `launch-report --recorded DIRECTORY` prints it. Throws TraceError for anything else.
RecordedProcesses parse_recorded_processes(const std::string& json);

// The processes of `counts`, none of which has lost anything, with the events that the session records. `now`
// (CLOCK_MONOTONIC, ns) is the end of those that have not told theirs.
std::vector<ProcessAccount> account_processes(const std::vector<EventCounts>& counts, const RecordedEvents& events,
                                              std::uint64_t now);

// Sets `lost` and `nodes` of `account.processes`, and its attribution.
void attribute_losses(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                      const RecordedProcesses& recorded, const std::vector<Stream>& streams);

}  // namespace tracing
