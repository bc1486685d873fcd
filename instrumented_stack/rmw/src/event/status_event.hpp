// SPDX-License-Identifier: Apache-2.0
// An event of a publisher or subscription that rmw_wait() can wait for: the status that DDS tells, gathered until
// somebody takes it.
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

  // Copies the status to `status`, which points to one of this event's type, and sets its changes back.
  virtual void take(void* status) = 0;

  // `callback` is told of every occurrence, and of a former one that was not taken.
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

  std::mutex mutex_;  // of the status
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

// Any thread. The status counts from the beginning, whether anybody asks for it or not.
template <typename StatusT>
class StatusEventOf final : public StatusEvent {
 public:
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
  StatusT status_{};
};

}  // namespace rmw_fastrtps
