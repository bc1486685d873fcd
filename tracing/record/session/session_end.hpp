// SPDX-License-Identifier: Apache-2.0
// The end of a session: stopped, written to the last byte, destroyed.
#pragma once

#include <functional>
#include <string>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/session/step_timer.hpp"

namespace tracing {

// How the wait for the last data ended. Stuck: LTTng says that there is data, and has written nothing for
// kLongestSilence (answer_limit.hpp), as when a rotation cannot end because a process died within an event.
enum class DataEnd { kWritten, kGivenUp, kStuck };

// Waits until the consumer daemon has written all that a stopped session has recorded into `directory`; another
// machine's is not looked at. Throws TraceError.
DataEnd wait_for_data(const std::string& lttng_session_name, const std::string& directory,
                      const std::function<bool()>& give_up);

// LTTng ends a packet of every stream when a session stops, but none where the buffers are full: what was lost there
// since its last packet would be in no total. When the consumer has emptied them, a start and a stop make one more
// packet of each stream. What running programs fire between the two is recorded. Returns false if LTTng refuses, as
// while a rotation goes on, or the wait for the packets has been given up.
bool end_packets_again(const std::string& lttng_session_name, const std::string& directory,
                       const std::function<bool()>& give_up);

// Stops the session and reads its losses once they are final, or as they are when the wait ends. A session that fails
// in this can't be used any more and is destroyed. Throws TraceError.
LossAccount stop_and_account(const std::string& lttng_session_name, const std::string& directory,
                             const std::function<bool()>& give_up, StepTimer& timer);

// Returns when nothing is left of the session, give_up says so, or it takes kLongestSilence. Throws TraceError.
void destroy_session(const std::string& lttng_session_name, const std::function<bool()>& give_up);

// The same for a session that was rotated: LTTng moves its last files to the archive half a second after the session
// has gone from the list. Returns when the files are there, give_up says so, or it takes kLongestSilence; false if they
// are not there. Throws TraceError.
bool destroy_rotated_session(const std::string& lttng_session_name, const std::function<bool()>& give_up);

}  // namespace tracing
