// SPDX-License-Identifier: Apache-2.0
#pragma once

// Records deadline misses, as events of provider `ros2_deadline`: callbacks that run longer than
// TRACETOOLS_CALLBACK_DEADLINE nanoseconds, and messages that are taken more than TRACETOOLS_MESSAGE_DEADLINE
// nanoseconds after they were published. This finds a rare event without recording all the others.

#include <cstdint>

namespace tracetools {

// Called when the provider has been loaded.
void read_deadlines() noexcept;

namespace detail {
extern std::int64_t callback_deadline;  // ns; 0: none
extern std::int64_t message_deadline;
void note_callback_start() noexcept;
void check_callback(const void* callback) noexcept;
void note_message(const void* rmw_subscription_handle, const void* message, std::int64_t source_timestamp) noexcept;
void check_message(const void* message) noexcept;
}  // namespace detail

// Whether there is a deadline. Costs a load and a branch.
inline bool watches_callbacks() noexcept {
  return detail::callback_deadline != 0;
}
inline bool watches_messages() noexcept {
  return detail::message_deadline != 0;
}

// Called before and after each callback, on its thread. Callbacks may nest.
inline void callback_starts() noexcept {
  if (watches_callbacks()) {
    detail::note_callback_start();
  }
}
inline void callback_ends(const void* callback) noexcept {
  if (watches_callbacks()) {
    detail::check_callback(callback);
  }
}

// A message was taken from the middleware, then passed to rcl by the same thread. Messages that the middleware takes
// for itself are not passed on and may be old. `source_timestamp`: nanoseconds since the epoch on the publisher's
// system clock, 0 or less if unknown.
inline void message_taken(const void* rmw_subscription_handle, const void* message, std::int64_t source_timestamp,
                          bool taken) noexcept {
  if (watches_messages() && taken) {
    detail::note_message(rmw_subscription_handle, message, source_timestamp);
  }
}
inline void message_handed_on(const void* message) noexcept {
  if (watches_messages()) {
    detail::check_message(message);
  }
}

}  // namespace tracetools
