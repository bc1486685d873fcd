// SPDX-License-Identifier: Apache-2.0
// What was dropped on purpose, for recording it cost too much.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/plan/trace_config.hpp"

namespace tracing {

// A class of events (event_classes.hpp) that was dropped because recording cost too much.
struct EventCut {
  std::string event_class = {};
  std::vector<std::string> events = {};
  std::int64_t time = 0;   // CLOCK_MONOTONIC, ns
  std::uint64_t rate = 0;  // events a second of all processes before it
  double share = 0;        // of a processor that they cost, estimated
};

// The cuts of a session stand in a file beside the counters, so that whoever ends the session knows of them.
void note_cut(const TraceConfig& config, const EventCut& cut);
std::vector<EventCut> read_cuts(const TraceConfig& config);

}  // namespace tracing
