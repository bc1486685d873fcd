// SPDX-License-Identifier: Apache-2.0
// Keeps a user's callback at an address that rcl can call.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "rmw/event_callback_type.h"

namespace rclcpp::detail {

class OnReadyCallback {
 public:
  // `set_in_rcl` gets a C function and its user data and passes them to rcl. When it returns, rcl no longer calls the
  // former ones. Exceptions must not pass through C, so they are logged; `what` names the entity in the log. Throws
  // std::invalid_argument for an empty callback, with `function` as the name of the called function.
  template <typename SetInRclT>
  void set(std::function<void(size_t)> callback, const char* function, const char* what, SetInRclT set_in_rcl) {
    std::unique_ptr<Target> target = make_target(std::move(callback), function, what);
    const std::lock_guard lock(mutex_);
    set_in_rcl(&call, static_cast<const void*>(target.get()));
    target_ = std::move(target);
  }

  template <typename SetInRclT>
  void clear(SetInRclT set_in_rcl) {
    const std::lock_guard lock(mutex_);
    if (target_) {
      set_in_rcl(nullptr, hands_back_ ? rmw_event_callback_hands_back : nullptr);
      target_.reset();
    }
  }

  // While one lives, this thread clears callbacks for an executor that an entity leaves: what it was told of and has
  // not executed yet, the next callback is told of.
  class HandBack {
   public:
    HandBack() : before_(hands_back_) { hands_back_ = true; }
    ~HandBack() { hands_back_ = before_; }
    HandBack(const HandBack&) = delete;
    HandBack& operator=(const HandBack&) = delete;

   private:
    bool before_;
  };

 private:
  struct Target {
    std::function<void(size_t)> callback;
    const char* what;
  };

  static std::unique_ptr<Target> make_target(std::function<void(size_t)> callback, const char* function,
                                             const char* what);
  static void call(const void* target, size_t count);

  static thread_local bool hands_back_;
  std::mutex mutex_;
  std::unique_ptr<Target> target_;
};

}  // namespace rclcpp::detail
