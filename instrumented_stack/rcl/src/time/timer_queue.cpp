// SPDX-License-Identifier: Apache-2.0
#include "time/timer_queue.hpp"

#include <algorithm>

namespace rcl {
namespace {

constexpr auto kLater = [](const auto& a, const auto& b) { return a.due > b.due; };

}  // namespace

void TimerQueue::assign(const std::vector<const rcl_timer_t*>& timers) {
  timers_ = timers;
  forget_times();
}

void TimerQueue::clear() {
  timers_.clear();
  clocks_.clear();
  forget_times();
}

rcl_ret_t TimerQueue::time_until_first(int64_t& time) {
  time = kNever;
  if (const rcl_ret_t result = read_times(); result != RCL_RET_OK) {
    return result;
  }
  for (OfClock& of_clock : clocks_) {
    if (const rcl_ret_t result = settle_first(of_clock.heap); result != RCL_RET_OK) {
      return result;
    }
    if (of_clock.heap.empty()) {
      continue;
    }
    rcl_time_point_value_t now = 0;
    if (const rcl_ret_t result = rcl_clock_get_now(of_clock.clock, &now); result != RCL_RET_OK) {
      return result;
    }
    time = std::min(time, of_clock.heap.front().due - now);
  }
  return RCL_RET_OK;
}

rcl_ret_t TimerQueue::append_due(std::vector<size_t>& indices) {
  if (const rcl_ret_t result = read_times(); result != RCL_RET_OK) {
    return result;
  }
  const auto before = static_cast<std::ptrdiff_t>(indices.size());
  for (const OfClock& of_clock : clocks_) {
    if (of_clock.heap.empty()) {
      continue;
    }
    rcl_time_point_value_t now = 0;
    if (const rcl_ret_t result = rcl_clock_get_now(of_clock.clock, &now); result != RCL_RET_OK) {
      return result;
    }
    // What lies below an entry in the heap is not due before it.
    to_visit_.assign(1, 0);
    while (!to_visit_.empty()) {
      const size_t at = to_visit_.back();
      to_visit_.pop_back();
      if (at >= of_clock.heap.size() || of_clock.heap[at].due > now) {
        continue;
      }
      Entry entry = of_clock.heap[at];
      bool has_gone = false;
      if (const rcl_ret_t result = update(entry, has_gone); result != RCL_RET_OK) {
        return result;
      }
      if (!has_gone && entry.due <= now) {
        indices.push_back(entry.index);
      }
      to_visit_.push_back(2 * at + 1);
      to_visit_.push_back(2 * at + 2);
    }
  }
  std::sort(indices.begin() + before, indices.end());
  return RCL_RET_OK;
}

rcl_ret_t TimerQueue::read_times() {
  if (has_times_) {
    return RCL_RET_OK;
  }
  clocks_.clear();
  for (size_t i = 0; i < timers_.size(); ++i) {
    Entry entry{0, i};
    bool has_gone = false;
    if (const rcl_ret_t result = update(entry, has_gone); result != RCL_RET_OK) {
      return result;
    }
    if (has_gone) {
      continue;
    }
    std::vector<Entry>* heap = nullptr;
    if (const rcl_ret_t result = heap_of(*timers_[i], heap); result != RCL_RET_OK) {
      return result;
    }
    heap->push_back(entry);
  }
  for (OfClock& of_clock : clocks_) {
    std::make_heap(of_clock.heap.begin(), of_clock.heap.end(), kLater);
  }
  has_times_ = true;
  return RCL_RET_OK;
}

rcl_ret_t TimerQueue::heap_of(const rcl_timer_t& timer, std::vector<Entry>*& heap) {
  rcl_clock_t* clock = nullptr;
  if (const rcl_ret_t result = rcl_timer_clock(&timer, &clock); result != RCL_RET_OK) {
    return result;
  }
  rcl_clock_type_t kind = clock->type;
  if (kind == RCL_ROS_TIME) {
    bool is_simulated = false;
    if (const rcl_ret_t result = rcl_is_enabled_ros_time_override(clock, &is_simulated); result != RCL_RET_OK) {
      return result;
    }
    kind = is_simulated ? RCL_ROS_TIME : RCL_SYSTEM_TIME;
  }
  auto found = std::find_if(clocks_.begin(), clocks_.end(), [&](const OfClock& of_clock) {
    return of_clock.kind == kind && (kind != RCL_ROS_TIME || of_clock.clock == clock);
  });
  if (found == clocks_.end()) {
    found = clocks_.insert(found, OfClock{kind, clock, {}});
  }
  heap = &found->heap;
  return RCL_RET_OK;
}

rcl_ret_t TimerQueue::settle_first(std::vector<Entry>& heap) {
  while (!heap.empty()) {
    Entry first = heap.front();
    bool has_gone = false;
    if (const rcl_ret_t result = update(first, has_gone); result != RCL_RET_OK) {
      return result;
    }
    if (!has_gone && first.due == heap.front().due) {
      return RCL_RET_OK;
    }
    std::pop_heap(heap.begin(), heap.end(), kLater);
    heap.pop_back();
    if (!has_gone) {
      heap.push_back(first);
      std::push_heap(heap.begin(), heap.end(), kLater);
    }
  }
  return RCL_RET_OK;
}

rcl_ret_t TimerQueue::update(Entry& entry, bool& has_gone) const {
  const rcl_ret_t result = rcl_timer_get_next_call_time(timers_[entry.index], &entry.due);
  has_gone = result == RCL_RET_TIMER_CANCELED;
  return has_gone ? RCL_RET_OK : result;
}

}  // namespace rcl
