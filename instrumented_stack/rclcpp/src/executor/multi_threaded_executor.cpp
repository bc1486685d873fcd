// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/executors/multi_threaded_executor.hpp"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "executor/executor_entities.hpp"

namespace rclcpp::executors {

namespace {

// Gives the group back at its end.
class BusyGroup {
 public:
  BusyGroup(CallbackGroup::SharedPtr group, ExecutorEntities& entities)
      : group_(std::move(group)), entities_(entities) {}
  ~BusyGroup() {
    entities_.begin_giving_back();
    group_->give_back();
    entities_.end_giving_back();
  }
  RCLCPP_DISABLE_COPY(BusyGroup)

 private:
  const CallbackGroup::SharedPtr group_;
  ExecutorEntities& entities_;
};

}  // namespace

MultiThreadedExecutor::MultiThreadedExecutor(const ExecutorOptions& options, size_t number_of_threads,
                                             bool yield_before_execute, std::chrono::nanoseconds timeout)
    : Executor(options),
      number_of_threads_(number_of_threads > 0 ? number_of_threads : std::max(std::thread::hardware_concurrency(), 2U)),
      yield_before_execute_(yield_before_execute),
      next_exec_timeout_(timeout) {}

void MultiThreadedExecutor::spin() {
  const SpinningScope scope(*this, "spin()");
  std::vector<std::thread> threads;
  for (size_t i = 1; i < number_of_threads_; ++i) {
    threads.emplace_back([this] { run_and_keep_failure(); });
  }
  run_and_keep_failure();
  for (std::thread& thread : threads) {
    thread.join();
  }
  if (failure_) {
    std::rethrow_exception(std::exchange(failure_, nullptr));
  }
}

void MultiThreadedExecutor::run_and_keep_failure() {
  try {
    run();
  } catch (...) {
    {
      const std::lock_guard lock(failure_mutex_);
      if (!failure_) {
        failure_ = std::current_exception();
      }
    }
    cancel();
  }
}

void MultiThreadedExecutor::run() {
  const progress::Spin spin(progress::Doing::kNothing);
  while (context_->is_valid() && spinning_) {
    AnyExecutable any_executable;
    progress::does(progress::Doing::kNothing);  // another thread may wait for all of them
    {
      const std::lock_guard lock(wait_mutex_);
      if (!context_->is_valid() || !spinning_) {
        return;
      }
      progress::does(progress::Doing::kBetween);
      if (!get_next_executable(any_executable, next_exec_timeout_)) {
        continue;
      }
    }
    if (yield_before_execute_) {
      std::this_thread::yield();
    }
    if (any_executable.callback_group->type() == CallbackGroupType::MutuallyExclusive) {
      {
        const BusyGroup group(std::move(any_executable.callback_group), *entities_);
        execute_any_executable(any_executable);
      }
      interrupt();  // the thread that waits passes over the group
    } else {
      execute_any_executable(any_executable);
    }
  }
}

}  // namespace rclcpp::executors
