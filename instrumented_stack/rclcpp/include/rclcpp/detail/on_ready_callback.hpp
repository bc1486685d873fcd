// SPDX-License-Identifier: Apache-2.0
// A user's callback at an address that rcl can call.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace rclcpp::detail {

class OnReadyCallback {
 public:
  // `set_in_rcl` gets a C function and its user data and hands them to rcl, which calls the former ones no more when it
  // returns. `what` names the entity in the log when the callback throws: exceptions must not pass through C.
  // Throws std::invalid_argument for an empty callback, with `function` as the name of the one that was called.
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
      set_in_rcl(nullptr, nullptr);
      target_.reset();
    }
  }

 private:
  struct Target {
    std::function<void(size_t)> callback;
    const char* what;
  };

  static std::unique_ptr<Target> make_target(std::function<void(size_t)> callback, const char* function,
                                             const char* what);
  static void call(const void* target, size_t count);

  std::mutex mutex_;
  std::unique_ptr<Target> target_;
};

}  // namespace rclcpp::detail
