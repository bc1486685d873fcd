// SPDX-License-Identifier: Apache-2.0
// A library to preload: the time of day jumps by an hour with each look at it, forwards and backwards in turn. Clocks
// that only run forwards are as they are.
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr time_t kHour = 3600;

time_t jump() {
  static thread_local bool forwards = false;
  forwards = !forwards;
  return forwards ? kHour : -kHour;
}

}  // namespace

extern "C" {

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long result = ::syscall(SYS_clock_gettime, clock, time);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
    time->tv_sec += jump();
  }
  return static_cast<int>(result);
}

int gettimeofday(timeval* now, void*) noexcept {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  *now = {time.tv_sec, time.tv_nsec / 1000};
  return 0;
}

time_t time(time_t* now) noexcept {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  if (now != nullptr) {
    *now = time.tv_sec;
  }
  return time.tv_sec;
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
}
