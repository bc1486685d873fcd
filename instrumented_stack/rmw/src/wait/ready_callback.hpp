// SPDX-License-Identifier: Apache-2.0
// The callback that a Waitable calls when something has come. Waiters are woken as well.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>

#include "rmw/event_callback_type.h"

namespace rmw_fastrtps {

class ReadyCallback {
 public:
  // After this, the former callback does not run any more. What it was told of, a later one is not, unless `user_data`
  // says that it was handed back.
  void set(rmw_event_callback_t callback, const void* user_data) {
    const std::lock_guard lock(mutex_);
    if (callback == nullptr && user_data == rmw_event_callback_hands_back) {
      told_ = 0;
    }
    callback_ = callback;
    user_data_ = user_data;
    is_set_.store(callback != nullptr, std::memory_order_release);
  }

  bool is_set() const { return is_set_.load(std::memory_order_acquire); }

  // Calls the callback with `count`.
  void tell(std::size_t count) {
    const std::lock_guard lock(mutex_);
    if (callback_ != nullptr && count != 0) {
      callback_(user_data_, count);
    }
  }

  // Calls the callback with the samples of `available` that are new: all but the samples that a callback was told of
  // and that no thread has tried to take since. At least `unheard` of them have come while there was no callback; they
  // may have pushed out what was told.
  void tell_available(std::size_t available, std::size_t unheard = 0) {
    const std::lock_guard lock(mutex_);
    const std::size_t told = told_;
    const std::size_t count = std::max(available - std::min(told, available), std::min(unheard, available));
    if (callback_ != nullptr && count > 0) {
      told_ = available;
      callback_(user_data_, count);
    }
  }

  // Call this before every attempt to take. A sample that arrives in between leads to one call too many, never to one
  // too few.
  void about_to_take() {
    if (told_.load(std::memory_order_acquire) > 0) {
      const std::lock_guard lock(mutex_);
      if (told_ > 0) {
        --told_;
      }
    }
  }

 private:
  std::mutex mutex_;
  rmw_event_callback_t callback_ = nullptr;
  const void* user_data_ = nullptr;
  std::atomic<std::size_t> told_{0};  // changes under the lock
  std::atomic<bool> is_set_{false};
};

}  // namespace rmw_fastrtps
