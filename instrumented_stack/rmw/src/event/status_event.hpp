// SPDX-License-Identifier: Apache-2.0
// An event of a publisher or subscription that rmw_wait() can wait for. It gathers the status that DDS reports until
// the status is taken.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>

#include "rmw/event_callback_type.h"
#include "rmw/events_statuses.h"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

class StatusEvent : public Waitable {
 public:
  bool is_ready() override { return has_occurred_.load(std::memory_order_acquire); }

  // Copies the status to `status`, which must point to this event's type, and sets its changes back to 0.
  virtual void take(void* status) = 0;

  // `callback` is called for every occurrence, and for earlier ones that were neither told nor taken.
  void set_callback(rmw_event_callback_t callback, const void* user_data) {
    const std::lock_guard lock(callback_mutex_);
    callback_ = callback;
    user_data_ = user_data;
    if (callback == nullptr && user_data == rmw_event_callback_hands_back && is_ready() && untold_ == 0) {
      untold_ = 1;
    }
    if (callback != nullptr) {
      if (const std::size_t untold = untold_.exchange(0); untold > 0) {
        callback(user_data, untold);
      }
    }
  }

 protected:
  void occurred() {
    has_occurred_.store(true, std::memory_order_release);
    notify();
    const std::lock_guard lock(callback_mutex_);
    if (callback_ != nullptr) {
      callback_(user_data_, 1);
    } else {
      ++untold_;
    }
  }

  // Call it when the status is taken.
  void was_taken() {
    has_occurred_.store(false, std::memory_order_release);
    untold_ = 0;
  }

  std::mutex mutex_;  // guards the status
  std::atomic<bool> has_occurred_{false};

 private:
  std::mutex callback_mutex_;
  rmw_event_callback_t callback_ = nullptr;
  const void* user_data_ = nullptr;
  std::atomic<std::size_t> untold_{0};  // occurrences since the last take that no callback was told of
};

inline void reset_changes(rmw_matched_status_t& status) {
  status.total_count_change = 0;
  status.current_count_change = 0;
}
inline void reset_changes(rmw_liveliness_changed_status_t& status) {
  status.alive_count_change = 0;
  status.not_alive_count_change = 0;
}
template <typename StatusT>
void reset_changes(StatusT& status) {
  status.total_count_change = 0;
}

// Any thread may call it. The status counts from the beginning, whether or not it is ever asked for.
template <typename StatusT>
class StatusEventOf final : public StatusEvent {
 public:
  explicit StatusEventOf(const StatusT& status = {}) : status_(status) {}

  template <typename UpdateT>
  void update(UpdateT update) {
    {
      const std::lock_guard lock(mutex_);
      update(status_);
    }
    occurred();
  }

  void take(void* status) override {
    const std::lock_guard lock(mutex_);
    was_taken();
    *static_cast<StatusT*>(status) = status_;
    reset_changes(status_);
  }

 private:
  StatusT status_;
};

}  // namespace rmw_fastrtps
