// SPDX-License-Identifier: Apache-2.0
// Sessions, and events that could be recorded, for people.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/traceable_events.hpp"

namespace tracing {

// As `launch trace list`, `status` and `events` print them; each line ends with a line break.
std::string sessions_as_text(const std::vector<SessionSummary>& sessions);
std::string session_as_text(const SessionDetails& session);
std::string events_as_text(const TraceableEvents& events);

}  // namespace tracing
