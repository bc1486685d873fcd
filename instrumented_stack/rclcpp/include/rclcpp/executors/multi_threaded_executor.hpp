// SPDX-License-Identifier: Apache-2.0
// Runs callbacks in several threads. Callbacks of a reentrant group may run at the same time, those of a mutually
// exclusive group run one at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>

#include "rclcpp/executor.hpp"

namespace rclcpp::executors {

// One thread at a time waits for work. The others execute, or queue for their turn to wait.
class MultiThreadedExecutor : public Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MultiThreadedExecutor)

  // `number_of_threads` includes the thread that calls spin(); 0: one per processor, at least 2. With
  // `yield_before_execute` a thread yields to others before each callback. `timeout` limits each wait for work;
  // negative: no limit.
  explicit MultiThreadedExecutor(const ExecutorOptions& options = ExecutorOptions(), size_t number_of_threads = 0,
                                 bool yield_before_execute = false,
                                 std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));

  // If a callback throws, all threads end, and spin() throws the first exception.
  void spin() override;

  size_t get_number_of_threads() const { return number_of_threads_; }

 private:
  void run();
  void run_and_keep_failure();

  const size_t number_of_threads_;
  const bool yield_before_execute_;
  const std::chrono::nanoseconds next_exec_timeout_;
  std::mutex wait_mutex_;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace rclcpp::executors
