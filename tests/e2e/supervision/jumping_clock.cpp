// SPDX-License-Identifier: Apache-2.0
// A library to preload: the time of day jumps by JUMP_SECONDS with each look at it, forwards and backwards in turn.
// Clocks that only run forwards are as they are.
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>

namespace {

// An hour if nothing is said.
time_t jump_length() {
  const char* const text = ::getenv("JUMP_SECONDS");
  return text == nullptr ? 3600 : std::atol(text);
}

time_t jump() {
  static thread_local bool forwards = false;
  forwards = !forwards;
  return forwards ? jump_length() : -jump_length();
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
