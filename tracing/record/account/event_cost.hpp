// SPDX-License-Identifier: Apache-2.0
// The time that a traced thread spends to record one event. It is measured on this machine, and kept in a file.
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

// $XDG_CACHE_HOME/launch/event_cost.json, or that of ~/.cache. Without HOME, the home directory is that of the password
// database.
std::filesystem::path event_cost_file();

// What was measured before, on this processor with this LTTng and these context fields.
std::optional<EventCost> known_event_cost(const std::vector<std::string>& context_fields);

// Keeps it for known_event_cost(). A link at the place of the file is replaced and not followed; a link of another user
// on the way to it is refused. Throws TraceError.
void remember(const EventCost& cost);

}  // namespace tracing
