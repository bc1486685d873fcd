// SPDX-License-Identifier: Apache-2.0
// Work without a purpose: a thread uses its processor for a given time.
#pragma once

#include <cstdint>

namespace twin_node {

// Counts from `begin_ns` (monotonic_ns()), or soon after: the time that passes, or with `processor_time` the time that
// the thread has a processor (CLOCK_THREAD_CPUTIME_ID). As long as nobody has taken the processor away these are the
// same, so that is asked only at the end: the question itself takes longer than the shortest callbacks.
class Work {
 public:
  Work(std::int64_t begin_ns, bool processor_time);
  // Goes on until this much has been done since then.
  void until(std::int64_t time_ns) const;

 private:
  std::int64_t begin_ns_;
  bool processor_time_;
  std::int64_t used_ns_ = 0;
  long preemptions_ = 0;
};

// Sleeps, using nothing.
void sleep_for(std::int64_t time_ns);
// Sleeps until CLOCK_MONOTONIC has this time.
void sleep_until(std::int64_t time_ns);
std::int64_t monotonic_ns();

}  // namespace twin_node
