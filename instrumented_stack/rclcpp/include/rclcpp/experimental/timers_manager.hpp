// SPDX-License-Identifier: Apache-2.0
// Runs timers without a wait set. Either an executor calls it in its own thread, or it uses a thread of its own.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "rclcpp/context.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp::experimental {

// Thread safe. Holds timers weakly. Looks at all timers to find the next one, so it suits some hundreds, not more.
class TimersManager {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(TimersManager)

  // `on_change` is called when get_head_timeout() may have become shorter, by the thread that caused it. It must only
  // take note.
  explicit TimersManager(std::shared_ptr<rclcpp::Context> context, std::function<void()> on_change = nullptr);
  ~TimersManager();
  RCLCPP_DISABLE_COPY(TimersManager)

  void add_timer(const TimerBase::SharedPtr& timer);
  void remove_timer(const TimerBase::SharedPtr& timer);
  void clear();

  // Executes timers in a thread of this object until stop(). Throws std::runtime_error if the thread runs already. An
  // exception of a callback ends the program, as in any thread.
  void start();
  void stop();

  // Executes the timer that has been due longest. Returns false if none is due.
  bool execute_head_timer();
  size_t get_number_ready_timers();

  // The time until the next timer is due, on its clock. Negative if it is overdue, the largest value if there is none.
  std::chrono::nanoseconds get_head_timeout();

 private:
  std::vector<TimerBase::SharedPtr> living();
  void run();
  void changed();

  const std::shared_ptr<rclcpp::Context> context_;
  const std::function<void()> on_change_;
  std::mutex mutex_;
  std::vector<TimerBase::WeakPtr> timers_;

  std::mutex thread_mutex_;
  std::condition_variable thread_wakes_;
  bool has_changed_ = false;
  bool running_ = false;
  std::thread thread_;
};

}  // namespace rclcpp::experimental
