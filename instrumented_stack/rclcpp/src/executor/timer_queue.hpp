// SPDX-License-Identifier: Apache-2.0
// The timers of an executor, ordered by the time at which they are due. A wait looks only at the next timers.
//
// Call assign() with all timers, ask time_until_first() before a wait and append_due() after it. Call forget_times()
// when the guard condition of a timer was triggered.
#pragma once

#include <rcl/timer.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace rclcpp {

// There is a heap for each clock. The queue does not learn that a timer was called or cancelled. The entry of the timer
// then tells too early a time, and is corrected when it comes first. A reset, or a jump of simulated time, can make a
// timer due earlier than its entry tells. Both trigger the guard condition of the timer.
//
// For one thread at a time. The functions throw if rcl reports an error.
class TimerQueue {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  struct Timer {
    const rcl_timer_t* handle;
    const std::atomic_bool* may_be_taken;  // while it is false, the timer counts as cancelled
  };

  // Replaces the timers. They must live until the next call of assign(), or until the destructor.
  void assign(std::vector<Timer> timers);

  // Lets the queue read the times anew before its next answer.
  void forget_times() { has_times_ = false; }

  struct First {
    // Nanoseconds until the timer is due by its clock. 0 or less if it is due already, `kNever` if there is no timer.
    std::int64_t time_until = kNever;
    std::size_t index = 0;
  };
  // The timer that is due first. Of several that are due at one time, the one with the lowest index.
  First first();
  std::int64_t time_until_first() { return first().time_until; }

  // Appends the indices of the timers that are due, in ascending order.
  void append_due(std::vector<std::size_t>& indices);

  // For executors that remember what is due. Appends the indices of the timers that are due, of one clock after the
  // other, in the order of their times. They are left out until put_back().
  void take_due(std::vector<std::size_t>& indices);
  // After assign(), for a timer that is remembered.
  void leave_out(std::size_t index) { is_left_out_[index] = true; }
  void put_back(std::size_t index);

 private:
  struct Entry {
    std::int64_t due;  // the timer is due at this time or later
    std::size_t index;
  };
  // Clocks that tell one time count as one clock: all steady clocks, and all clocks of system time. A ROS clock tells
  // system time while nothing simulates time. When a simulation begins or ends, guard conditions are triggered.
  struct OfClock {
    rcl_clock_type_t kind;
    rcl_clock_t* clock;
    std::vector<Entry> heap;       // the earliest first
    std::vector<Entry> held_back;  // entries that came first while they may not be taken
  };

  void read_times();
  OfClock& clock_of(const Timer& timer);
  void return_held_back(OfClock& of_clock);
  // Corrects entries until the first one is right and its timer may be taken. Removes the entries of cancelled timers.
  void settle_first(OfClock& of_clock);
  bool may_be_taken(const Entry& entry) const { return timers_[entry.index].may_be_taken->load(); }
  // Corrects the entry. False if the timer is cancelled.
  bool update(Entry& entry) const;

  std::vector<Timer> timers_;
  std::vector<bool> is_left_out_;
  std::vector<OfClock> clocks_;
  std::vector<std::size_t> to_visit_;
  bool has_times_ = false;
};

}  // namespace rclcpp
