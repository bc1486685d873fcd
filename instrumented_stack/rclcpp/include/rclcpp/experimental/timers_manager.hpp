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
#include <thread>
#include <vector>

#include "rclcpp/context.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

class TimerQueue;

namespace experimental {

// Thread safe. Holds timers weakly. They are in a heap: to find and to execute the next one costs the logarithm of
// their number.
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
  // Gives up the timers that have ended. Until then their rcl timers are kept.
  void remove_expired();
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
  struct Timer {
    TimerBase::WeakPtr timer;
    std::shared_ptr<const rcl_timer_t> handle;  // the queue refers to it
  };

  // These with the mutex held. What is taken out is to be released without it: the end of an rcl timer locks its clock.
  template <typename PredicateT>
  std::vector<Timer> take_out(PredicateT predicate);
  void empty_queue();
  TimerQueue& queue();
  void run();
  void changed();

  const std::shared_ptr<rclcpp::Context> context_;
  const std::function<void()> on_change_;
  std::mutex mutex_;
  std::vector<Timer> timers_;
  const std::unique_ptr<TimerQueue> queue_;  // of `timers_`, with their indices
  bool is_queue_filled_ = false;
  std::atomic_bool are_times_changed_{false};

  std::mutex thread_mutex_;
  std::condition_variable thread_wakes_;
  bool has_changed_ = false;
  bool running_ = false;
  std::thread thread_;
};

}  // namespace experimental

}  // namespace rclcpp
