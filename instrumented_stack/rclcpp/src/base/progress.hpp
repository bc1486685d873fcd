// SPDX-License-Identifier: Apache-2.0
// Tells the launcher that watches this process what each thread of an executor does, and since when
// (executor_progress/progress_page.hpp). Without such a launcher a call is a load and a branch.
//
// The functions are for the thread that spins.
#pragma once

#include <time.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <executor_progress/progress_page.hpp>

namespace rclcpp::progress {

using executor_progress::Doing;

namespace detail {
// Whether a launcher watches.
extern std::atomic<bool> is_watched;
void tell(Doing doing, std::uint64_t time) noexcept;
Doing told() noexcept;
// Of a clock of which a reading costs a few nanoseconds; it is up to 4 ms late.
inline std::uint64_t now() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(time.tv_nsec);
}
}  // namespace detail

// This process has an executor, or will have one.
void join() noexcept;

// From now on the thread does this.
inline void does(Doing doing) noexcept {
  if (detail::is_watched.load(std::memory_order_relaxed)) {
    detail::tell(doing, detail::now());
  }
}

// It waits so long at most; a negative time, or the longest one, is without limit.
inline void waits(std::chrono::nanoseconds timeout) noexcept {
  if (detail::is_watched.load(std::memory_order_relaxed)) {
    // A year is no less than for ever, and the sum below stays a time.
    constexpr std::chrono::hours kLong(24 * 365);
    detail::tell(Doing::kWaiting, timeout.count() < 0 || timeout > kLong
                                      ? executor_progress::kNever
                                      : detail::now() + static_cast<std::uint64_t>(timeout.count()));
  }
}

// A function that spins begins, and when it returns the thread does `then`; or goes on with the callback that spins.
class Spin {
 public:
  explicit Spin(Doing then) noexcept : then_(then) {
    if (detail::is_watched.load(std::memory_order_relaxed)) {
      const Doing before = detail::told();
      then_ = before >= Doing::kTimer && before <= Doing::kWaitable ? before : then;
      does(Doing::kBetween);
    }
  }
  ~Spin() { does(then_); }
  Spin(const Spin&) = delete;
  Spin& operator=(const Spin&) = delete;

 private:
  Doing then_;
};

// A callback runs while this lives.
class Callback {
 public:
  explicit Callback(Doing kind) noexcept { does(kind); }
  ~Callback() { does(Doing::kBetween); }
  Callback(const Callback&) = delete;
  Callback& operator=(const Callback&) = delete;
};

}  // namespace rclcpp::progress
