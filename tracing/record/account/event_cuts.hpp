// SPDX-License-Identifier: Apache-2.0
// Classes of events that were dropped because recording them cost too much.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// A class of events (event_classes.hpp) that was dropped because recording cost too much.
struct EventCut {
  std::string event_class = {};
  std::vector<std::string> events = {};
  std::int64_t time = 0;   // CLOCK_MONOTONIC, ns
  std::uint64_t rate = 0;  // events a second of all processes before the cut
  double share = 0;        // of a processor that they cost, estimated
};

// The cuts of a session are kept in a file beside the counters, so that the program that ends the session knows them.
void note_cut(const TraceConfig& config, const EventCut& cut);
std::vector<EventCut> read_cuts(const TraceConfig& config);

}  // namespace tracing
