// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/experimental/timers_manager.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rclcpp::experimental {

namespace {

using std::chrono::nanoseconds;

bool refers_to(const TimerBase::WeakPtr& weak, const TimerBase::SharedPtr& timer) {
  return !weak.owner_before(timer) && !timer.owner_before(weak);
}

}  // namespace

TimersManager::TimersManager(std::shared_ptr<rclcpp::Context> context, std::function<void()> on_change)
    : context_(std::move(context)), on_change_(std::move(on_change)) {}

TimersManager::~TimersManager() {
  clear();
  stop();
}

void TimersManager::add_timer(const TimerBase::SharedPtr& timer) {
  if (!timer) {
    throw std::invalid_argument("TimersManager::add_timer() trying to add nullptr timer");
  }
  {
    const std::lock_guard lock(mutex_);
    timers_.erase(std::remove_if(timers_.begin(), timers_.end(),
                                 [&](const auto& weak) { return weak.expired() || refers_to(weak, timer); }),
                  timers_.end());
    timers_.push_back(timer);
  }
  timer->set_on_reset_callback([this](size_t) { changed(); });
  changed();
}

void TimersManager::remove_timer(const TimerBase::SharedPtr& timer) {
  timer->clear_on_reset_callback();
  const std::lock_guard lock(mutex_);
  timers_.erase(
      std::remove_if(timers_.begin(), timers_.end(), [&](const auto& weak) { return refers_to(weak, timer); }),
      timers_.end());
}

void TimersManager::clear() {
  for (const TimerBase::SharedPtr& timer : living()) {
    remove_timer(timer);
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
  nanoseconds head_time(1);
  for (TimerBase::SharedPtr& timer : living()) {
    const nanoseconds time = timer->time_until_trigger();
    if (time < head_time) {
      head_time = time;
      head = std::move(timer);
    }
  }
  if (!head || head_time > nanoseconds::zero()) {
    return false;
  }
  const std::shared_ptr<void> data = head->call();
  if (!data) {
    return false;
  }
  head->execute_callback(data);
  return true;
}

size_t TimersManager::get_number_ready_timers() {
  const std::vector<TimerBase::SharedPtr> timers = living();
  return static_cast<size_t>(std::count_if(timers.begin(), timers.end(), [](const auto& t) { return t->is_ready(); }));
}

nanoseconds TimersManager::get_head_timeout() {
  nanoseconds head_time = nanoseconds::max();
  for (const TimerBase::SharedPtr& timer : living()) {
    head_time = std::min(head_time, timer->time_until_trigger());
  }
  return head_time;
}

std::vector<TimerBase::SharedPtr> TimersManager::living() {
  const std::lock_guard lock(mutex_);
  std::vector<TimerBase::SharedPtr> timers;
  for (const TimerBase::WeakPtr& weak : timers_) {
    if (TimerBase::SharedPtr timer = weak.lock()) {
      timers.push_back(std::move(timer));
    }
  }
  return timers;
}

void TimersManager::run() {
  while (context_->is_valid()) {
    const nanoseconds timeout = get_head_timeout();
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
    execute_head_timer();
  }
}

void TimersManager::changed() {
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
