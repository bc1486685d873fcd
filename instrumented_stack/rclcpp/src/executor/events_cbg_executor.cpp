// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/executors/events_cbg_executor/events_cbg_executor.hpp"

#include <algorithm>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "executor/executor_entities.hpp"
#include "executor/group_connections.hpp"
#include "executor/group_queues.hpp"

namespace rclcpp::executors {

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

}  // namespace

EventsCBGExecutor::EventsCBGExecutor(const ExecutorOptions& options, size_t number_of_threads, nanoseconds timeout)
    : Executor(options),
      number_of_threads_(number_of_threads > 0 ? number_of_threads : std::max(std::thread::hardware_concurrency(), 2U)),
      next_exec_timeout_(timeout),
      queues_(std::make_shared<GroupQueues>()),
      connections_(std::make_unique<GroupConnections>(*entities_, queues_)) {
  entities_->set_on_change([this] {
    has_changed_ = true;
    queues_->interrupt();
  });
}

EventsCBGExecutor::~EventsCBGExecutor() {
  spinning_ = false;
  entities_->set_on_change(nullptr);
  entities_->remove_all();
  connections_->disconnect_unserved();
}

void EventsCBGExecutor::spin() {
  spin(nullptr);
}

void EventsCBGExecutor::spin(const ExceptionHandler& exception_handler) {
  const SpinningScope scope(*this, "spin()");
  std::vector<std::thread> threads;
  for (size_t i = 1; i < number_of_threads_; ++i) {
    threads.emplace_back([&] { run_and_keep_failure(exception_handler); });
  }
  run_and_keep_failure(exception_handler);
  for (std::thread& thread : threads) {
    thread.join();
  }
  if (failure_) {
    std::rethrow_exception(std::exchange(failure_, nullptr));
  }
}

void EventsCBGExecutor::run_and_keep_failure(const ExceptionHandler& exception_handler) {
  while (context_->is_valid() && spinning_) {
    try {
      try {
        run();
      } catch (const std::exception& error) {
        if (!exception_handler) {
          throw;
        }
        exception_handler(error);
      }
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
}

[[gnu::hot]] void EventsCBGExecutor::run() {
  GroupQueues::Work work(*queues_);
  while (true) {
    const std::uint64_t seen = queues_->interruptions();
    if (!context_->is_valid() || !spinning_) {
      return;
    }
    connect_what_changed();
    if (queues_->wait(work, next_exec_timeout_, seen)) {
      work.execute([this](AnyExecutable& executable) { execute_chosen(executable); });
    }
  }
}

[[gnu::hot]] void EventsCBGExecutor::spin_once_impl(nanoseconds timeout) {
  const auto start = timeout > nanoseconds::zero() ? steady_clock::now() : steady_clock::time_point();
  GroupQueues::Work work(*queues_);
  nanoseconds left = timeout;
  while (true) {
    const std::uint64_t seen = queues_->interruptions();
    if (!context_->is_valid() || !spinning_) {
      return;
    }
    connect_what_changed();
    if (queues_->wait(work, left, seen)) {
      work.execute([this](AnyExecutable& executable) { execute_chosen(executable); });
      return;
    }
    if (timeout > nanoseconds::zero()) {
      left = std::max<nanoseconds>(timeout - (steady_clock::now() - start), nanoseconds::zero());
    }
    if (left == nanoseconds::zero() && seen == queues_->interruptions()) {
      return;
    }
  }
}

void EventsCBGExecutor::spin_some_impl(nanoseconds max_duration, bool exhaustive) {
  execute_ready(max_duration, exhaustive);
}

bool EventsCBGExecutor::collect_and_execute_ready_events(nanoseconds max_duration,
                                                         bool recollect_if_no_work_available) {
  const SpinningScope scope(*this, "collect_and_execute_ready_events()");
  return execute_ready(max_duration, recollect_if_no_work_available);
}

bool EventsCBGExecutor::execute_ready(nanoseconds max_duration, bool exhaustive) {
  const auto start = steady_clock::now();
  const auto time_left = [&] {
    return max_duration == nanoseconds::zero() || steady_clock::now() - start < max_duration;
  };
  bool has_executed = false;
  const auto execute_all = [&](auto before) {
    GroupQueues::Work work(*queues_);
    while (context_->is_valid() && spinning_ && time_left()) {
      before();
      if (!queues_->take(work)) {
        return;
      }
      has_executed = true;
      work.execute([this](AnyExecutable& executable) { execute_chosen(executable); });
    }
  };
  connect_what_changed();
  if (exhaustive) {
    execute_all([this] { connect_what_changed(); });
  } else {
    const GroupQueues::OnlyWhatIsReady only(*queues_);
    execute_all([] {});
  }
  return has_executed;
}

void EventsCBGExecutor::connect_what_changed() {
  if (has_changed_.load(std::memory_order_relaxed) && has_changed_.exchange(false)) {
    connections_->update();
  }
}

void EventsCBGExecutor::add_callback_group_only(const CallbackGroup::SharedPtr& group) {
  add_callback_group(group, nullptr);
}

void EventsCBGExecutor::remove_node(const NodePtr& node, bool notify) {
  Executor::remove_node(node, notify);
  connections_->disconnect_unserved();
}

void EventsCBGExecutor::remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify) {
  Executor::remove_callback_group(group, notify);
  connections_->disconnect_unserved();
}

}  // namespace rclcpp::executors
