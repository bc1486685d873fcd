// SPDX-License-Identifier: Apache-2.0
// The end of a session: stopped, written to the last byte, destroyed.
#pragma once

#include <functional>
#include <string>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/session/step_timer.hpp"

namespace tracing {

// Waits until the consumer daemon has written all that a stopped session has recorded. False if give_up said so first.
// Throws TraceError.
bool wait_for_data(const std::string& lttng_session_name, const std::function<bool()>& give_up);

// Stops the session and reads its losses once they are final, or as they are when give_up says so. A session that fails
// in this can't be used any more and is destroyed. Throws TraceError.
LossAccount stop_and_account(const std::string& lttng_session_name, const std::function<bool()>& give_up,
                             StepTimer& timer);

// Returns when nothing is left of the session, or give_up says so. Throws TraceError.
void destroy_session(const std::string& lttng_session_name, const std::function<bool()>& give_up);

// The same for a session that was rotated: LTTng moves its last files to the archive half a second after the session
// has gone from the list. Returns when the files are there, or give_up says so. Throws TraceError.
void destroy_rotated_session(const std::string& lttng_session_name, const std::function<bool()>& give_up);

}  // namespace tracing
