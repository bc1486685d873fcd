// SPDX-License-Identifier: Apache-2.0
// When the participant of a new context is introduced to others.
//
// A node makes some twenty endpoints, one after the other. If others know its participant by then, each of the
// endpoints goes to each of the others in a message of its own. So the participant is introduced when the thread that
// makes the node has come to rest: it waits for something, and no endpoint has come for a moment. A thread that waits
// for a processor only, because many nodes start at once, is not at rest.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>

namespace rmw_fastrtps {

class Introduction {
 public:
  using Clock = std::chrono::steady_clock;

  // Without an endpoint for this long, the thread is looked at; again and again while it is busy.
  static constexpr Clock::duration kMoment = std::chrono::milliseconds(2);
  // A thread that does something else than making endpoints delays the introduction at most so long.
  static constexpr Clock::duration kLongest = std::chrono::seconds(1);

  Introduction(Clock::time_point now, std::function<bool()> is_thread_busy);

  // An endpoint has come.
  void put_off(Clock::time_point now) { next_ = now + kMoment; }

  // When to ask is_due() again.
  Clock::time_point next() const { return next_; }
  bool is_due(Clock::time_point now);

 private:
  Clock::time_point next_;
  Clock::time_point latest_;
  std::function<bool()> is_thread_busy_;
};

// Whether a thread of this process runs, or would run if it had a processor.
bool is_busy(pid_t thread);

}  // namespace rmw_fastrtps
