// SPDX-License-Identifier: Apache-2.0
// An event of a publisher or subscription that rmw_wait() can wait for. It gathers the status that DDS reports until
// the status is taken.
#pragma once

#include <atomic>
#include <mutex>

#include "rmw/events_statuses.h"
#include "wait/ready_callback.hpp"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

class StatusEvent : public Waitable {
 public:
  bool is_ready() override { return has_occurred_.load(std::memory_order_acquire); }

  // Copies the status to `status`, which must point to this event's type, and sets its changes back to 0.
  virtual void take(void* status) = 0;

  // `callback` is called for every occurrence, and for earlier ones that were not taken.
  void set_callback(rmw_event_callback_t callback, const void* user_data) {
    callback_.set(callback, user_data);
    if (is_ready()) {
      callback_.tell(1);
    }
  }

 protected:
  void occurred() {
    has_occurred_.store(true, std::memory_order_release);
    notify();
    callback_.tell(1);
  }

  std::mutex mutex_;  // guards the status
  std::atomic<bool> has_occurred_{false};

 private:
  ReadyCallback callback_;
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
    has_occurred_.store(false, std::memory_order_release);
    *static_cast<StatusT*>(status) = status_;
    reset_changes(status_);
  }

 private:
  StatusT status_;
};

}  // namespace rmw_fastrtps
