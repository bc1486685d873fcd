// SPDX-License-Identifier: Apache-2.0
// Measures what it costs a traced thread to record one event.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/account/event_cost.hpp"

namespace tracing {

// Measures with a session of its own that writes nothing: the program launch-trace-probe fires some ten thousand events
// with two pointers, in batches, into buffers that overwrite, and takes the median of the batches. About 30 ms when a
// session daemon and its consumer run; starts them when they don't. Throws TraceError.
EventCost calibrate(const std::vector<std::string>& context_fields);

// What is known, or is measured now and remembered. Throws TraceError when it can't be measured.
EventCost event_cost(const std::vector<std::string>& context_fields);
// The same, nothing for an error.
std::optional<EventCost> try_event_cost(const std::vector<std::string>& context_fields);

}  // namespace tracing
