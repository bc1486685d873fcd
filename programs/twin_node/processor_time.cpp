// SPDX-License-Identifier: Apache-2.0
#include "programs/twin_node/processor_time.hpp"

#include <sys/resource.h>

#include <cerrno>
#include <ctime>

namespace twin_node {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t time_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

long preemptions_of_thread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

}  // namespace

Work::Work(std::int64_t begin_ns, bool processor_time) : begin_ns_(begin_ns), processor_time_(processor_time) {
  if (processor_time_) {
    used_ns_ = time_of(CLOCK_THREAD_CPUTIME_ID);
    preemptions_ = preemptions_of_thread();
  }
}

void Work::until(std::int64_t time_ns) const {
  while (monotonic_ns() - begin_ns_ < time_ns) {
  }
  if (processor_time_ && preemptions_of_thread() != preemptions_) {
    while (time_of(CLOCK_THREAD_CPUTIME_ID) - used_ns_ < time_ns) {
    }
  }
}

std::int64_t monotonic_ns() {
  return time_of(CLOCK_MONOTONIC);
}

void sleep_until(std::int64_t time_ns) {
  const timespec time{time_ns / kSecond, time_ns % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

void sleep_for(std::int64_t time_ns) {
  sleep_until(monotonic_ns() + time_ns);
}

}  // namespace twin_node
