// SPDX-License-Identifier: Apache-2.0
#include "executor/timer_queue.hpp"

#include <algorithm>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

constexpr auto kLater = [](const auto& a, const auto& b) {
  return a.due > b.due || (a.due == b.due && a.index > b.index);
};

rcl_time_point_value_t now_of(rcl_clock_t* clock) {
  rcl_time_point_value_t now = 0;
  require_ok(rcl_clock_get_now(clock, &now), "couldn't read the clock of a timer");
  return now;
}

}  // namespace

void TimerQueue::assign(std::vector<Timer> timers) {
  timers_ = std::move(timers);
  is_left_out_.assign(timers_.size(), false);
  clocks_.clear();
  forget_times();
}

[[gnu::hot]] TimerQueue::First TimerQueue::first() {
  read_times();
  First first;
  for (OfClock& of_clock : clocks_) {
    return_held_back(of_clock);
    settle_first(of_clock);
    if (of_clock.heap.empty()) {
      continue;
    }
    const Entry& entry = of_clock.heap.front();
    const std::int64_t time_until = entry.due - now_of(of_clock.clock);
    if (time_until < first.time_until) {
      first = {time_until, entry.index};
    }
  }
  return first;
}

[[gnu::hot]] void TimerQueue::append_due(std::vector<std::size_t>& indices) {
  read_times();
  const auto before = static_cast<std::ptrdiff_t>(indices.size());
  const auto append = [&](Entry entry, rcl_time_point_value_t now) {
    if (may_be_taken(entry) && update(entry) && entry.due <= now) {
      indices.push_back(entry.index);
    }
  };
  for (const OfClock& of_clock : clocks_) {
    if (of_clock.heap.empty() && of_clock.held_back.empty()) {
      continue;
    }
    const rcl_time_point_value_t now = now_of(of_clock.clock);
    // Their group may have become free during the wait.
    for (const Entry& entry : of_clock.held_back) {
      append(entry, now);
    }
    // What lies below an entry in the heap is not due before it.
    to_visit_.assign(1, 0);
    while (!to_visit_.empty()) {
      const std::size_t at = to_visit_.back();
      to_visit_.pop_back();
      if (at >= of_clock.heap.size() || of_clock.heap[at].due > now) {
        continue;
      }
      append(of_clock.heap[at], now);
      to_visit_.push_back(2 * at + 1);
      to_visit_.push_back(2 * at + 2);
    }
  }
  std::sort(indices.begin() + before, indices.end());
}

[[gnu::hot]] void TimerQueue::take_due(std::vector<std::size_t>& indices) {
  read_times();
  for (OfClock& of_clock : clocks_) {
    settle_first(of_clock);
    if (of_clock.heap.empty()) {
      continue;
    }
    const rcl_time_point_value_t now = now_of(of_clock.clock);
    while (!of_clock.heap.empty() && of_clock.heap.front().due <= now) {
      const std::size_t index = of_clock.heap.front().index;
      std::pop_heap(of_clock.heap.begin(), of_clock.heap.end(), kLater);
      of_clock.heap.pop_back();
      is_left_out_[index] = true;
      indices.push_back(index);
      settle_first(of_clock);
    }
  }
}

[[gnu::hot]] void TimerQueue::put_back(std::size_t index) {
  is_left_out_[index] = false;
  Entry entry{0, index};
  if (!has_times_ || !update(entry)) {
    return;
  }
  std::vector<Entry>& heap = clock_of(timers_[index]).heap;
  heap.push_back(entry);
  std::push_heap(heap.begin(), heap.end(), kLater);
}

void TimerQueue::read_times() {
  if (has_times_) {
    return;
  }
  clocks_.clear();
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    Entry entry{0, i};
    if (!is_left_out_[i] && update(entry)) {
      clock_of(timers_[i]).heap.push_back(entry);
    }
  }
  for (OfClock& of_clock : clocks_) {
    std::make_heap(of_clock.heap.begin(), of_clock.heap.end(), kLater);
  }
  has_times_ = true;
}

TimerQueue::OfClock& TimerQueue::clock_of(const Timer& timer) {
  rcl_clock_t* clock = nullptr;
  require_ok(rcl_timer_clock(timer.handle, &clock), "couldn't get the clock of a timer");
  rcl_clock_type_t kind = clock->type;
  if (kind == RCL_ROS_TIME) {
    bool is_simulated = false;
    require_ok(rcl_is_enabled_ros_time_override(clock, &is_simulated), "couldn't ask a clock for simulated time");
    kind = is_simulated ? RCL_ROS_TIME : RCL_SYSTEM_TIME;
  }
  const auto found = std::find_if(clocks_.begin(), clocks_.end(), [&](const OfClock& of_clock) {
    return of_clock.kind == kind && (kind != RCL_ROS_TIME || of_clock.clock == clock);
  });
  return found != clocks_.end() ? *found : clocks_.emplace_back(OfClock{kind, clock, {}, {}});
}

void TimerQueue::return_held_back(OfClock& of_clock) {
  for (const Entry& entry : of_clock.held_back) {
    of_clock.heap.push_back(entry);
    std::push_heap(of_clock.heap.begin(), of_clock.heap.end(), kLater);
  }
  of_clock.held_back.clear();
}

void TimerQueue::settle_first(OfClock& of_clock) {
  std::vector<Entry>& heap = of_clock.heap;
  while (!heap.empty()) {
    Entry first = heap.front();
    const bool is_held_back = !may_be_taken(first);
    const bool is_alive = update(first);
    if (!is_held_back && is_alive && first.due == heap.front().due) {
      return;
    }
    std::pop_heap(heap.begin(), heap.end(), kLater);
    heap.pop_back();
    if (is_alive && is_held_back) {
      of_clock.held_back.push_back(first);
    } else if (is_alive) {
      heap.push_back(first);
      std::push_heap(heap.begin(), heap.end(), kLater);
    }
  }
}

bool TimerQueue::update(Entry& entry) const {
  const rcl_ret_t result = rcl_timer_get_next_call_time(timers_[entry.index].handle, &entry.due);
  if (result == RCL_RET_TIMER_CANCELED) {
    return false;
  }
  require_ok(result, "couldn't get the time of a timer");
  return true;
}

}  // namespace rclcpp
