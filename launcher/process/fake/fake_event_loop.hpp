// SPDX-License-Identifier: Apache-2.0
// An EventLoop for tests: time passes only when the test says so.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "launcher/process/event_loop.hpp"

namespace launch {

// Descriptors are real (a pipe, an eventfd) and are polled, timers run on virtual time that begins at zero, signals
// come from deliver_signal(). In each turn: signals, ready descriptors, exits (only when no descriptor was ready), due
// timers, posts. Exceptions of callbacks leave the call that ran them.
class FakeEventLoop final : public EventLoop {
 public:
  FakeEventLoop();
  ~FakeEventLoop() override;

  // Runs everything that is pending now, and what follows from it, without letting time pass.
  void run_until_idle();
  // Lets time pass, from timer to timer, running everything that becomes pending.
  void advance(Duration duration);
  // Lets time pass within a callback: what becomes due waits for the next turn.
  void pass(Duration duration) { now_ += duration; }
  // Delivers a signal to its callback in the next turn. Throws std::logic_error when there is no callback for it: a
  // real signal would have ended the process.
  void deliver_signal(int signal, bool by_terminal = false);

  // Runs pending callbacks, then jumps to the next timer, until quit(). Throws std::logic_error if nothing can happen
  // any more. A real loop would wait for ever then.
  void run() override;
  void quit() override { quit_ = true; }

  SourcePtr on_readable(int fd, Callback callback) override;
  SourcePtr on_writable(int fd, Callback callback) override;
  SourcePtr on_exit(int pidfd, Callback callback) override;
  SourcePtr after(Duration delay, Callback callback) override;
  SourcePtr on_signal(const std::vector<int>& signals, std::function<void(Signal)> callback) override;
  void post(Callback callback) override;
  Duration now() const override { return now_; }

 private:
  struct Registration;
  class Handle;
  using RegistrationPtr = std::shared_ptr<Registration>;
  using TimerKey = std::pair<Duration, std::uint64_t>;  // when, and in which order of requests

  SourcePtr watch(std::vector<RegistrationPtr>& list, int fd, Callback callback);
  bool run_signals();
  bool run_descriptors(std::vector<RegistrationPtr>& list, short events, bool once);
  bool run_due_timers();
  bool run_posts();

  Duration now_{0};
  bool quit_ = false;
  std::uint64_t timer_count_ = 0;
  std::vector<RegistrationPtr> readable_;
  std::vector<RegistrationPtr> writable_;
  std::vector<RegistrationPtr> exits_;
  std::map<TimerKey, RegistrationPtr> timers_;
  std::vector<RegistrationPtr> signals_;
  std::deque<Signal> delivered_signals_;
  std::mutex post_mutex_;
  std::deque<Callback> posts_;  // guarded by post_mutex_
};

}  // namespace launch
