// SPDX-License-Identifier: Apache-2.0
// The relay daemon that gets the trace of a session, at the end of the session: it may be stopped, or gone.
#pragma once

#include <optional>
#include <string>

#include "tracing/record/account/absence.hpp"
#include "tracing/record/lttng/daemons_kept_going.hpp"
#include "tracing/record/lttng/relay_connection.hpp"
#include "tracing/record/session/session_listing.hpp"

namespace tracing {

// Continues the relay daemon at the address if it is stopped, in the life of `daemons`. The session daemon makes the
// connection of a new session, and gives it to the consumer then.
void keep_relay_daemon(DaemonsKeptGoing& daemons, const std::string& address);

// The connections of a session that sends its trace to a relay daemon.
std::optional<RelayConnection> connection_of(const SessionSummary& session);

// How to end a session that could not be ended.
std::string end_it_later(const std::string& session_name);

// Whether the relay daemon has gone that gets the trace of the session. Throws TraceError if it is stopped: LTTng's
// consumer waits for its answers, and the session daemon for the consumer, for ever.
std::optional<Absence> look_for_relay_daemon(const SessionSummary& session);
// The same once it goes on, which somebody sees to (daemons_kept_going.hpp).
std::optional<Absence> wait_for_relay_daemon(const SessionSummary& session);
// What is lost if LTTng's consumer has gone, too.
Absence lost_with_consumer();

}  // namespace tracing
