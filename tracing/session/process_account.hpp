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

#include "tracing/session/event_counters.hpp"
#include "tracing/session/packet_index.hpp"
#include "tracing/session/tracer.hpp"

namespace tracing {

// What a trace holds of one process.
struct RecordedProcess {
  std::vector<std::string> nodes;               // fully qualified
  std::map<std::string, std::uint64_t> events;  // by name
};
using RecordedProcesses = std::map<std::int64_t, RecordedProcess>;  // by process id

// As `launch-report --recorded DIRECTORY` prints it. Throws TraceError for anything else.
RecordedProcesses parse_recorded_processes(const std::string& json);

// What the userspace channels of a session record.
struct RecordedEvents {
  struct Rule {
    std::string channel;
    std::string pattern;
    std::vector<std::string> exclusions = {};
    bool conditional = false;  // a filter or a log level decides

    bool takes(const std::string& event) const;
  };
  std::vector<Rule> rules;

  // In how many channels the event is recorded, each time that it is fired.
  std::size_t times(const std::string& event) const;
  // A process counts an event whether a filter takes it or not: nothing is known of losses among those that have one.
  bool countable(const std::string& event) const;
};

// The processes of `counts`, none of which has lost anything, with the events that the session records. `now`
// (CLOCK_MONOTONIC, ns) is the end of those that have not told theirs.
std::vector<ProcessAccount> account_processes(const std::vector<EventCounts>& counts, const RecordedEvents& events,
                                              std::uint64_t now);

// Sets `lost` and `nodes` of `account.processes`, and its attribution.
void attribute_losses(LossAccount& account, const std::vector<EventCounts>& counts, const RecordedEvents& events,
                      const RecordedProcesses& recorded, const std::vector<Stream>& streams);

}  // namespace tracing
