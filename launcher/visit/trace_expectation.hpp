// SPDX-License-Identifier: Apache-2.0
// What a <test> expects of the trace of its run. It is plain data: nothing has been checked yet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

// `percentile` of the times are within the bounds: 100 means all of them.
struct TimeBounds {
  Duration least{0};
  std::optional<Duration> most;
  double percentile = 100;
};

struct ExpectedEvent {
  std::string name;  // a name, or a pattern with * and ?
  SourceRange name_where;
  std::string condition;  // on fields, as `launch trace read --where` has it; empty: none
  SourceRange condition_where;
  std::uint64_t least = 1;
  std::optional<std::uint64_t> most;  // nullopt: any number
};

// Events of which each comes later than the one before.
struct ExpectedEventOrder {
  struct Step {
    ExpectedEvent event;
    std::string process;  // a name; empty: every process
    SourceRange process_where;
  };
  std::vector<Step> steps;
};

// The messages of a topic, from and to these nodes; empty: any.
struct ExpectedDelivery {
  std::string topic;
  std::string from;
  std::string to;
  std::uint64_t least = 1;
  std::uint64_t most_lost = 0;
};

// From the call of publish() to the begin of the callback that gets the message; or, if nodes are given, from the begin
// of a callback of the first node to the publication of the last one that follows from it.
struct ExpectedLatency {
  std::string topic;
  std::string from;
  std::string to;
  std::vector<std::string> nodes;
  std::uint64_t least = 1;
  TimeBounds time;
};

// How long callbacks take. Empty members accept any.
struct ExpectedCallback {
  std::string node;
  std::string topic;
  std::string service;
  std::string function;  // a part of its name
  std::uint64_t least = 1;
  TimeBounds time;
};

// How regularly the timers of a node fire.
struct ExpectedTimer {
  std::string node;
  Duration period{0};
  std::optional<Duration> jitter;  // the largest difference of an interval from the period
  double percentile = 100;         // of the intervals
  std::uint64_t most_missed = 0;   // periods in which it should have fired
};

// How often the callbacks of a node ask for memory.
struct ExpectedAllocations {
  std::string node;
  std::string state;  // of its life cycle; empty: any, and it needs none
  std::uint64_t most = 0;
};

using TraceExpectation = std::variant<ExpectedEvent, ExpectedEventOrder, ExpectedDelivery, ExpectedLatency,
                                      ExpectedCallback, ExpectedTimer, ExpectedAllocations>;

}  // namespace launch
