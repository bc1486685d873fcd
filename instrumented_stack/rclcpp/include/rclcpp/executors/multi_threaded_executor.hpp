// SPDX-License-Identifier: Apache-2.0
// Runs callbacks in several threads: those of a reentrant group beside one another, those of a mutually exclusive group
// one at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>

#include "rclcpp/executor.hpp"

namespace rclcpp::executors {

// One thread at a time waits for work; the others execute, or stand in line to wait.
class MultiThreadedExecutor : public Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MultiThreadedExecutor)

  // `number_of_threads` counts the one that calls spin(); 0: one per processor, at least 2. `yield_before_execute` lets
  // other threads go first before each callback. `timeout` limits each wait for work, negative: no limit.
  explicit MultiThreadedExecutor(const ExecutorOptions& options = ExecutorOptions(), size_t number_of_threads = 0,
                                 bool yield_before_execute = false,
                                 std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));

  // After an exception of a callback the threads end, and the first exception comes out here.
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
