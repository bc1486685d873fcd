// SPDX-License-Identifier: Apache-2.0
// What it costs a traced thread to record one event, measured on this machine and remembered.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

struct EventCost {
  double ns_per_event = 0;  // processor time of the thread that fires it
  // What it holds for:
  std::string cpu;    // model of the processor
  std::string lttng;  // version of LTTng-UST
  std::vector<std::string> context_fields;
  std::string measured;  // when, local time: "2026-11-21 20:15:00"
};

// The model of this machine's processor, from /proc/cpuinfo, or "unknown processor".
std::string processor_model();

// $XDG_CACHE_HOME/launch/event_cost.json, or that of ~/.cache.
std::filesystem::path event_cost_file();

// What was measured before, on this processor with this LTTng and these context fields.
std::optional<EventCost> known_event_cost(const std::vector<std::string>& context_fields);

// Measures with a session of its own that writes nothing: the program launch-trace-probe fires some ten thousand events
// with two pointers, in batches, into buffers that overwrite, and takes the median of the batches. About 30 ms when a
// session daemon and its consumer run; starts them when they don't. Throws TraceError.
EventCost calibrate(const std::vector<std::string>& context_fields);

// For known_event_cost(). Throws TraceError.
void remember(const EventCost& cost);

// What is known, or is measured now and remembered. Throws TraceError when it can't be measured.
EventCost event_cost(const std::vector<std::string>& context_fields);
// The same, nothing for an error.
std::optional<EventCost> try_event_cost(const std::vector<std::string>& context_fields);

}  // namespace tracing
