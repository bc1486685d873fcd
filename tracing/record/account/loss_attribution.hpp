// SPDX-License-Identifier: Apache-2.0
// Finds out which process lost how many of a session's events, and how many each process fired.
//
// Where each process has buffers of its own, their packets tell the losses. Where processes share buffers, lost =
// events fired (event_counters.hpp) − events in the trace. The losses of the channels are the check: where both sums
// are equal and no packet is missing, the account is exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// What a trace holds of one process.
struct RecordedProcess {
  std::vector<std::string> nodes = {};               // fully qualified
  std::map<std::string, std::uint64_t> events = {};  // by name
  std::string name = {};                             // of a thread
  double seconds = 0;                                // from its first event to its last
};
using RecordedProcesses = std::map<std::int64_t, RecordedProcess>;  // by process id

// As `launch-report --recorded DIRECTORY` prints it. Throws TraceError for anything else.
RecordedProcesses parse_recorded_processes(const std::string& json);

// An account for each process of `counts`, with the events that the session records and no losses yet. `now`
// (CLOCK_MONOTONIC, ns) is taken for the end of processes that have not told theirs.
std::vector<ProcessAccount> account_processes(const std::vector<EventCounts>& counts, const RecordedEvents& events,
                                              std::uint64_t now);

// Adds the events that processes do not count to `processes`: those of other providers than the stack's, such as
// LTTng's helper libraries, and all events of programs that count none, but the launcher.
void add_uncounted_events(std::vector<ProcessAccount>& processes, const RecordedProcesses& recorded);

// Sets `lost` and `nodes` of `account.processes`, and its attribution.
void attribute_losses(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                      const RecordedProcesses& recorded, const std::vector<Stream>& streams);

// Finds out how many events were in the packets that files of a limited size have overwritten: fired, neither in the
// trace nor discarded. Unknown if several channels have overwritten some, or packets were lost as well.
void count_overwritten(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                       const RecordedProcesses& recorded);

}  // namespace tracing
