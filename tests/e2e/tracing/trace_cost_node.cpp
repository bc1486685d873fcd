// SPDX-License-Identifier: Apache-2.0
// Usage: trace_cost_node MILLISECONDS
// One callback takes no time, then one takes this long. Of three messages that were published an hour ago, one does not
// arrive, one stays within the middleware, and one gets to rcl. Then the node waits for a signal.
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tracetools/tracetools.h"

namespace {

const void* handle(std::uintptr_t number) {
  return reinterpret_cast<const void*>(number);
}

std::int64_t nanoseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

void run_callback(std::uintptr_t callback, std::int64_t duration) {
  TRACETOOLS_TRACEPOINT(callback_start, handle(callback), false);
  for (const std::int64_t end = nanoseconds(CLOCK_MONOTONIC) + duration; nanoseconds(CLOCK_MONOTONIC) < end;) {
  }
  TRACETOOLS_TRACEPOINT(callback_end, handle(callback));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  run_callback(0x1, 0);
  run_callback(0x2, std::atoll(argv[1]) * 1'000'000);
  const std::int64_t hour_ago = nanoseconds(CLOCK_REALTIME) - std::int64_t{3600} * 1'000'000'000;
  TRACETOOLS_TRACEPOINT(rmw_take, handle(0x3), nullptr, hour_ago, false);
  TRACETOOLS_TRACEPOINT(rmw_take, handle(0x6), handle(0x7), hour_ago, true);
  TRACETOOLS_TRACEPOINT(rmw_take, handle(0x4), handle(0x5), hour_ago, true);
  TRACETOOLS_TRACEPOINT(rcl_take, handle(0x5));
  std::puts("done");
  std::fflush(stdout);
  pause();
}
