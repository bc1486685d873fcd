// SPDX-License-Identifier: Apache-2.0
// The events that one process contributed to a session, and the cost of tracing for this process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

// What a session had from one process.
struct ProcessAccount {
  std::string name;  // of its program
  std::int64_t pid = 0;
  double seconds = 0;                        // it ran
  double cpu_seconds = 0;                    // processor time of all its threads; 0: unknown, for it was killed
  std::uint64_t events = 0;                  // that it fired and the session recorded or lost, once for each channel
  std::uint64_t callbacks = 0;               // that ended, of its nodes
  std::optional<double> reached_after = {};  // seconds after its begin the first session reached it; nothing: none did
  std::uint64_t missed = 0;                  // events that it fired before
  std::optional<std::uint64_t> lost = {};    // of its events; nothing: unknown
  std::vector<std::string> nodes = {};       // its nodes; looked up when events were lost
  bool counts = true;                        // its events (event_counters.hpp); if not, `events` are those in the trace

  // Estimates, for events that take so many nanoseconds each.
  double tracing_seconds(double ns_per_event) const { return static_cast<double>(events) * ns_per_event / 1e9; }
  double processor_share(double ns_per_event) const;  // of one processor, while it ran
  double own_share(double ns_per_event) const;        // of its own processor time; 0: unknown
  double ns_per_callback(double ns_per_event) const;  // that tracing adds to a callback and what leads to it; 0: none
};

}  // namespace tracing
