// SPDX-License-Identifier: Apache-2.0
// A limit for how long LTTng's library waits for the session daemon, which has none of its own.
#pragma once

#include <chrono>

namespace tracing {

// The longest wait in which the daemon does nothing for us.
inline constexpr std::chrono::seconds kLongestSilence{10};

// Make one for the time of a call, while holding lttng_lock(). When the session daemon does not answer, and has used
// no processor time, for kLongestSilence, its connections are shut down, so that the call returns with an error. After
// that, calls have a tenth of the time, for three times as long: the end of a session makes several.
class AnswerLimit {
 public:
  AnswerLimit();
  ~AnswerLimit();
  AnswerLimit(const AnswerLimit&) = delete;
  AnswerLimit& operator=(const AnswerLimit&) = delete;

  // Whether the last call of this thread was ended so.
  static bool was_unanswered();
};

// kLongestSilence, or what a test has set.
std::chrono::milliseconds longest_silence();
void set_longest_silence(std::chrono::milliseconds silence);

}  // namespace tracing
