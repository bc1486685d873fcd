// SPDX-License-Identifier: Apache-2.0
// The timers that a wait set keeps, by the time at which they are due, so that a wait looks at the next ones and not at
// all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "rcl/timer.h"

namespace rcl {

// A heap for each clock. Nobody says when a timer is called or cancelled: its entry then tells too early a time, which
// is put right when its turn comes. What makes a timer due earlier than its entry tells, a reset or a jump of simulated
// time, triggers its guard condition: who sees that calls forget_times(). Of one thread at a time.
class TimerQueue {
 public:
  static constexpr int64_t kNever = std::numeric_limits<int64_t>::max();

  // They must live until the next call, or clear().
  void assign(const std::vector<const rcl_timer_t*>& timers);
  void clear();

  // Times are read anew before the next answer.
  void forget_times() { has_times_ = false; }

  // Nanoseconds until the first one is due, by its clock, 0 or less if one is already; `kNever` if all are cancelled.
  rcl_ret_t time_until_first(int64_t& time);

  // Appends the indices of those that are due, in ascending order.
  rcl_ret_t append_due(std::vector<size_t>& indices);

 private:
  struct Entry {
    int64_t due;  // or earlier than that
    size_t index;
  };
  // Clocks that tell one time count as one: all steady ones, and those of system time, which are also those of
  // simulated time while there is none. When that begins or ends, guard conditions are triggered.
  struct OfClock {
    rcl_clock_type_t kind;
    rcl_clock_t* clock;
    std::vector<Entry> heap;  // the earliest first
  };

  rcl_ret_t read_times();
  rcl_ret_t heap_of(const rcl_timer_t& timer, std::vector<Entry>*& heap);
  // Makes the first entry one that tells the truth; cancelled timers leave.
  rcl_ret_t settle_first(std::vector<Entry>& heap);
  // Nothing but RCL_RET_OK if the entry tells the truth now; `has_gone` if the timer is cancelled.
  rcl_ret_t update(Entry& entry, bool& has_gone) const;

  std::vector<const rcl_timer_t*> timers_;
  std::vector<OfClock> clocks_;
  std::vector<size_t> to_visit_;
  bool has_times_ = false;
};

}  // namespace rcl
