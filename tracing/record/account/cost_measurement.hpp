// SPDX-License-Identifier: Apache-2.0
// Measures what it costs a traced thread to record one event.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/record/account/event_cost.hpp"

namespace tracing {

// Measures with a session of its own that writes nothing: the program launch-trace-probe fires some ten thousand events
// with two pointers, in batches, into buffers that overwrite. The result is the median of the batches. Takes about 30
// ms when a session daemon and its consumer run, and starts them otherwise. Throws TraceError.
EventCost calibrate(const std::vector<std::string>& context_fields);

// The cost that is known, or else is measured now and remembered. Throws TraceError if it cannot be measured.
EventCost event_cost(const std::vector<std::string>& context_fields);
// As event_cost(); nothing if it cannot be measured.
std::optional<EventCost> try_event_cost(const std::vector<std::string>& context_fields);

}  // namespace tracing
