// SPDX-License-Identifier: Apache-2.0
// What the session daemon knows: the sessions that exist, one of them in detail, and what can be recorded now.
#pragma once

#include <string>
#include <vector>

#include "tracing/session/tracer.hpp"

namespace tracing {

// None when no session daemon runs. Throws TraceError.
std::vector<SessionSummary> list_sessions();

// With its channels and the counts of lost events so far. Throws TraceError, also when there is no such session.
SessionDetails describe_session(const std::string& lttng_session_name);

// Starts a session daemon when none runs, since programs tell their events to nobody else. Throws TraceError.
TraceableEvents list_traceable_events();

// As `launch trace list`, `status` and `events` print them; each line ends with a line break.
std::string sessions_as_text(const std::vector<SessionSummary>& sessions);
std::string session_as_text(const SessionDetails& session);
std::string events_as_text(const TraceableEvents& events);

}  // namespace tracing
