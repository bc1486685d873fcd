// SPDX-License-Identifier: Apache-2.0
// Lists what the session daemon knows: all sessions, one session in detail, and the events that can be recorded now.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/traceable_events.hpp"

namespace tracing {

// None when no session daemon runs. Throws TraceError.
std::vector<SessionSummary> list_sessions();

// The session of this name; nothing when there is none. Throws TraceError.
std::optional<SessionSummary> find_session(const std::string& lttng_session_name);

// With its channels and the counts of lost events so far, without held_up. Throws TraceError, also when there is no
// such session.
SessionDetails describe_session(const std::string& lttng_session_name);

// Throws TraceError.
bool has_buffers_of_processes(const std::string& lttng_session_name);

// Starts a session daemon when none runs, because programs report their events only to a daemon. Throws TraceError.
TraceableEvents list_traceable_events();

}  // namespace tracing
