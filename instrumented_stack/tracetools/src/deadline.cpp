// SPDX-License-Identifier: Apache-2.0
#include "deadline.hpp"

#include <time.h>

#include <array>
#include <cstddef>
#include <cstdlib>

#define LTTNG_UST_TRACEPOINT_DEFINE
#define LTTNG_UST_TRACEPOINT_PROBE_DYNAMIC_LINKAGE
#include "provider/provider_deadline.h"

namespace tracetools {
namespace detail {

std::int64_t callback_deadline = 0;
std::int64_t message_deadline = 0;

}  // namespace detail

namespace {

// When the callbacks of this thread started, the innermost last. Deeper nesting is ignored.
struct Started {
  std::array<std::int64_t, 16> times;
  std::size_t depth;
};
thread_local constinit Started started{};

// The last message that this thread has taken.
struct Taken {
  const void* subscription;
  const void* message;
  std::int64_t source_timestamp;
};
thread_local constinit Taken taken{};

std::int64_t nanoseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t nanoseconds_in(const char* variable) {
  const char* const value = std::getenv(variable);
  const long long number = value != nullptr ? std::atoll(value) : 0;
  return number > 0 ? number : 0;
}

}  // namespace

void read_deadlines() noexcept {
  detail::callback_deadline = nanoseconds_in("TRACETOOLS_CALLBACK_DEADLINE");
  detail::message_deadline = nanoseconds_in("TRACETOOLS_MESSAGE_DEADLINE");
}

void detail::note_callback_start() noexcept {
  if (started.depth < started.times.size()) {
    started.times[started.depth] = nanoseconds(CLOCK_MONOTONIC);
  }
  ++started.depth;
}

void detail::check_callback(const void* callback) noexcept {
  if (started.depth == 0) {
    return;
  }
  if (--started.depth >= started.times.size()) {
    return;
  }
  const std::int64_t duration = nanoseconds(CLOCK_MONOTONIC) - started.times[started.depth];
  if (duration > callback_deadline) {
    lttng_ust_tracepoint(ros2_deadline, callback, callback, duration, callback_deadline);
  }
}

void detail::note_message(const void* rmw_subscription_handle, const void* message,
                          std::int64_t source_timestamp) noexcept {
  taken = {.subscription = rmw_subscription_handle, .message = message, .source_timestamp = source_timestamp};
}

void detail::check_message(const void* message) noexcept {
  if (taken.message != message || taken.source_timestamp <= 0) {
    return;
  }
  const std::int64_t age = nanoseconds(CLOCK_REALTIME) - taken.source_timestamp;
  taken.source_timestamp = 0;
  if (age > message_deadline) {
    lttng_ust_tracepoint(ros2_deadline, message, taken.subscription, message, age, message_deadline);
  }
}

}  // namespace tracetools
