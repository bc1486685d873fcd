// SPDX-License-Identifier: Apache-2.0
// When a session was paused, for the account of processes that ran meanwhile.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"

namespace tracing {

// Notes in the directory of the counters that the session pauses or resumes now. Does nothing for "".
void note_pause(const std::string& counters, const std::string& lttng_session_name);
void note_resume(const std::string& counters, const std::string& lttng_session_name);

// Whether it has ever been paused.
bool was_paused(const std::string& counters, const std::string& lttng_session_name);

// What a process fires while the session is paused is not missed. So nothing is known of what is missing of a
// process that began in a pause, or for which a pause began before a session reached it. Its `missed` becomes 0.
void forgive_pauses(std::vector<EventCounts>& counts, const std::string& counters,
                    const std::string& lttng_session_name);

}  // namespace tracing
