// SPDX-License-Identifier: Apache-2.0
// Reads what the tracer's counters say about events that it could not keep.
#pragma once

#include <string>

#include "tracing/session/process_account.hpp"
#include "tracing/session/tracer.hpp"

namespace tracing {

// The losses per channel so far. The session must still exist; the numbers are final once it is stopped and no data is
// pending. Throws TraceError.
LossAccount read_losses(const std::string& lttng_session_name);

// What the userspace channels of the session record. Throws TraceError.
RecordedEvents read_recorded_events(const std::string& lttng_session_name);

// One line per channel with losses ("12 events lost in ust channel ros2"), or "no events lost".
std::string describe_losses(const LossAccount& losses);

// What tracing has cost the processes, estimated, as one line: all of them and the one that it has cost most. "" where
// the cost of an event isn't known, or no event was counted.
std::string describe_cost(const LossAccount& losses);

}  // namespace tracing
