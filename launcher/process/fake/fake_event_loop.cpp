// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/fake/fake_event_loop.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <stdexcept>

namespace launch {

struct FakeEventLoop::Registration {
  int fd = -1;
  std::set<int> signals;
  Callback callback;
  std::function<void(Signal)> signal_callback;
  bool cancelled = false;
};

class FakeEventLoop::Handle final : public Source {
 public:
  explicit Handle(RegistrationPtr registration) : registration_(std::move(registration)) {}
  ~Handle() override { registration_->cancelled = true; }

 private:
  RegistrationPtr registration_;
};

FakeEventLoop::FakeEventLoop() = default;
FakeEventLoop::~FakeEventLoop() = default;

EventLoop::SourcePtr FakeEventLoop::watch(std::vector<RegistrationPtr>& list, int fd, Callback callback) {
  auto registration = std::make_shared<Registration>();
  registration->fd = fd;
  registration->callback = std::move(callback);
  list.push_back(registration);
  return std::make_unique<Handle>(std::move(registration));
}

EventLoop::SourcePtr FakeEventLoop::on_readable(int fd, Callback callback) {
  return watch(readable_, fd, std::move(callback));
}

EventLoop::SourcePtr FakeEventLoop::on_writable(int fd, Callback callback) {
  return watch(writable_, fd, std::move(callback));
}

EventLoop::SourcePtr FakeEventLoop::on_exit(int pidfd, Callback callback) {
  return watch(exits_, pidfd, std::move(callback));
}

EventLoop::SourcePtr FakeEventLoop::after(Duration delay, Callback callback) {
  auto registration = std::make_shared<Registration>();
  registration->callback = std::move(callback);
  const Duration due = delay > Duration::max() - now_ ? Duration::max() : now_ + std::max(delay, Duration{0});
  timers_.emplace(TimerKey{due, timer_count_++}, registration);
  return std::make_unique<Handle>(std::move(registration));
}

EventLoop::SourcePtr FakeEventLoop::on_signal(const std::vector<int>& signals, std::function<void(Signal)> callback) {
  auto registration = std::make_shared<Registration>();
  registration->signals = std::set<int>(signals.begin(), signals.end());
  registration->signal_callback = std::move(callback);
  signals_.push_back(registration);
  return std::make_unique<Handle>(std::move(registration));
}

void FakeEventLoop::post(Callback callback) {
  const std::lock_guard lock(post_mutex_);
  posts_.push_back(std::move(callback));
}

void FakeEventLoop::deliver_signal(int signal, bool by_terminal) {
  const bool watched = std::any_of(signals_.begin(), signals_.end(), [&](const RegistrationPtr& registration) {
    return !registration->cancelled && registration->signals.contains(signal);
  });
  if (!watched) {
    throw std::logic_error(fmt::format("signal {} was delivered, but nobody watches it", signal));
  }
  delivered_signals_.push_back({signal, by_terminal});
}

void FakeEventLoop::run_until_idle() {
  while (!quit_) {
    const bool busy = run_signals() || run_descriptors(readable_, POLLIN, false) ||
                      run_descriptors(writable_, POLLOUT, false) || run_descriptors(exits_, POLLIN, true) ||
                      run_due_timers() || run_posts();
    if (!busy) {
      return;
    }
  }
}

void FakeEventLoop::advance(Duration duration) {
  const Duration end = now_ + duration;
  run_until_idle();
  while (!quit_ && !timers_.empty() && timers_.begin()->first.first <= end) {
    now_ = std::max(now_, timers_.begin()->first.first);
    run_until_idle();
  }
  now_ = std::max(now_, end);
}

void FakeEventLoop::run() {
  run_until_idle();
  while (!quit_) {
    std::erase_if(timers_, [](const auto& timer) { return timer.second->cancelled; });
    if (timers_.empty()) {
      throw std::logic_error("the loop would wait for ever: nothing is pending and no timer runs");
    }
    now_ = std::max(now_, timers_.begin()->first.first);
    run_until_idle();
  }
  quit_ = false;
}

bool FakeEventLoop::run_signals() {
  if (delivered_signals_.empty()) {
    return false;
  }
  const Signal signal = delivered_signals_.front();
  delivered_signals_.pop_front();
  const std::vector<RegistrationPtr> watchers = signals_;
  for (const RegistrationPtr& watcher : watchers) {
    if (!watcher->cancelled && watcher->signals.contains(signal.number)) {
      watcher->signal_callback(signal);
    }
  }
  std::erase_if(signals_, [](const RegistrationPtr& watcher) { return watcher->cancelled; });
  return true;
}

bool FakeEventLoop::run_descriptors(std::vector<RegistrationPtr>& list, short events, bool once) {
  std::erase_if(list, [](const RegistrationPtr& registration) { return registration->cancelled; });
  std::vector<pollfd> descriptors;
  descriptors.reserve(list.size());
  for (const RegistrationPtr& registration : list) {
    descriptors.push_back({registration->fd, events, 0});
  }
  if (::poll(descriptors.data(), descriptors.size(), 0) <= 0) {
    return false;
  }
  const std::vector<RegistrationPtr> watchers = list;
  for (std::size_t i = 0; i < watchers.size() && !quit_; ++i) {
    if (descriptors[i].revents != 0 && !watchers[i]->cancelled) {
      watchers[i]->cancelled = once;
      watchers[i]->callback();
    }
  }
  return true;
}

bool FakeEventLoop::run_due_timers() {
  if (timers_.empty() || timers_.begin()->first.first > now_) {
    return false;
  }
  const RegistrationPtr timer = timers_.begin()->second;
  timers_.erase(timers_.begin());
  if (!timer->cancelled) {
    timer->callback();
  }
  return true;
}

bool FakeEventLoop::run_posts() {
  std::deque<Callback> batch;
  {
    const std::lock_guard lock(post_mutex_);
    batch.swap(posts_);
  }
  for (const Callback& callback : batch) {
    callback();
  }
  return !batch.empty();
}

}  // namespace launch
