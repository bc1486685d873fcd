// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/experimental/timers_manager.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/progress.hpp"
#include "executor/timer_queue.hpp"

namespace rclcpp::experimental {

namespace {

using std::chrono::nanoseconds;

bool refers_to(const TimerBase::WeakPtr& weak, const TimerBase::SharedPtr& timer) {
  return !weak.owner_before(timer) && !timer.owner_before(weak);
}

constexpr auto kHasEnded = [](const auto& known) { return known.timer.expired(); };

}  // namespace

TimersManager::TimersManager(std::shared_ptr<rclcpp::Context> context, std::function<void()> on_change)
    : context_(std::move(context)), on_change_(std::move(on_change)), queue_(std::make_unique<TimerQueue>()) {}

TimersManager::~TimersManager() {
  clear();
  stop();
}

void TimersManager::add_timer(const TimerBase::SharedPtr& timer) {
  if (!timer) {
    throw std::invalid_argument("TimersManager::add_timer() trying to add nullptr timer");
  }
  std::vector<Timer> removed;
  {
    const std::lock_guard lock(mutex_);
    removed = take_out([&](const Timer& known) { return refers_to(known.timer, timer); });
    empty_queue();
    timers_.push_back({timer, timer->get_timer_handle()});
  }
  timer->set_on_reset_callback([this](size_t) { changed(); });
  changed();
}

void TimersManager::remove_timer(const TimerBase::SharedPtr& timer) {
  std::vector<Timer> removed;
  {
    const std::lock_guard lock(mutex_);
    removed = take_out([&](const Timer& known) { return refers_to(known.timer, timer); });
  }
  if (!removed.empty()) {  // another one may have set the callback of a timer that is not known here
    timer->clear_on_reset_callback();
  }
}

void TimersManager::remove_expired() {
  std::vector<Timer> removed;
  const std::lock_guard lock(mutex_);
  removed = take_out(kHasEnded);
}

void TimersManager::clear() {
  std::vector<Timer> timers;
  {
    const std::lock_guard lock(mutex_);
    empty_queue();
    timers.swap(timers_);
  }
  for (const Timer& known : timers) {
    if (const TimerBase::SharedPtr timer = known.timer.lock()) {
      timer->clear_on_reset_callback();
    }
  }
}

void TimersManager::start() {
  const std::lock_guard lock(thread_mutex_);
  if (running_) {
    throw std::runtime_error("TimersManager::start() can't start timers thread as already running");
  }
  running_ = true;
  thread_ = std::thread([this] { run(); });
}

void TimersManager::stop() {
  {
    const std::lock_guard lock(thread_mutex_);
    running_ = false;
  }
  thread_wakes_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool TimersManager::execute_head_timer() {
  TimerBase::SharedPtr head;
  std::vector<Timer> removed;
  {
    const std::lock_guard lock(mutex_);
    while (!head) {
      const TimerQueue::First first = queue().first();
      if (first.time_until > 0) {
        return false;
      }
      head = timers_[first.index].timer.lock();
      if (!head) {
        removed = take_out(kHasEnded);
      }
    }
  }
  const std::shared_ptr<void> data = head->call();
  if (!data) {
    return false;
  }
  const progress::Callback callback(progress::Doing::kTimer);
  head->execute_callback(data);
  return true;
}

size_t TimersManager::get_number_ready_timers() {
  const std::lock_guard lock(mutex_);
  std::vector<size_t> due;
  queue().append_due(due);
  return due.size();
}

nanoseconds TimersManager::get_head_timeout() {
  std::vector<Timer> removed;
  const std::lock_guard lock(mutex_);
  while (true) {
    const TimerQueue::First first = queue().first();
    if (first.time_until == TimerQueue::kNever || !timers_[first.index].timer.expired()) {
      return nanoseconds(first.time_until);
    }
    removed = take_out(kHasEnded);
  }
}

template <typename PredicateT>
std::vector<TimersManager::Timer> TimersManager::take_out(PredicateT predicate) {
  const auto end = std::stable_partition(timers_.begin(), timers_.end(), std::not_fn(predicate));
  if (end == timers_.end()) {
    return {};
  }
  empty_queue();
  std::vector<Timer> taken(std::make_move_iterator(end), std::make_move_iterator(timers_.end()));
  timers_.erase(end, timers_.end());
  return taken;
}

void TimersManager::empty_queue() {
  queue_->assign({});
  is_queue_filled_ = false;
}

TimerQueue& TimersManager::queue() {
  static const std::atomic_bool kMayBeTaken{true};  // the executor does not look at groups
  if (are_times_changed_.exchange(false)) {
    queue_->forget_times();
  }
  if (!is_queue_filled_) {
    std::vector<TimerQueue::Timer> timers;
    for (const Timer& timer : timers_) {
      timers.push_back({timer.handle.get(), &kMayBeTaken});
    }
    queue_->assign(std::move(timers));
    is_queue_filled_ = true;
  }
  return *queue_;
}

void TimersManager::run() {
  const progress::Spin spin(progress::Doing::kNothing);
  while (context_->is_valid()) {
    const nanoseconds timeout = get_head_timeout();
    progress::waits(timeout);
    {
      std::unique_lock lock(thread_mutex_);
      const auto wakes = [this] { return has_changed_ || !running_; };
      if (timeout == nanoseconds::max()) {
        thread_wakes_.wait(lock, wakes);
      } else {
        thread_wakes_.wait_until(lock, std::chrono::steady_clock::now() + timeout, wakes);
      }
      if (!running_) {
        return;
      }
      has_changed_ = false;
    }
    progress::does(progress::Doing::kBetween);
    execute_head_timer();
  }
}

void TimersManager::changed() {
  are_times_changed_ = true;
  {
    const std::lock_guard lock(thread_mutex_);
    has_changed_ = true;
  }
  thread_wakes_.notify_all();
  if (on_change_) {
    on_change_();
  }
}

}  // namespace rclcpp::experimental
