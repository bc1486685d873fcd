// SPDX-License-Identifier: Apache-2.0
// The loop that everything of a launch runs on: children, pipes, timers, signals.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace launch {

using Duration = std::chrono::nanoseconds;

// Single-threaded: all calls but post() and all callbacks are made on the thread that runs the loop.
class EventLoop {
 public:
  // Keeps a registration alive; destroying it cancels the callback. Safe to destroy inside its own callback.
  class Source {
   public:
    virtual ~Source() = default;
  };
  using SourcePtr = std::unique_ptr<Source>;
  using Callback = std::function<void()>;

  struct Signal {
    int number;
    bool by_terminal = false;  // Ctrl-C and the like: the whole foreground group has got it
  };

  virtual ~EventLoop() = default;

  // Calls back whenever `fd` is readable, at end of file and on errors too. Does not own the descriptor.
  [[nodiscard]] virtual SourcePtr on_readable(int fd, Callback callback) = 0;
  // Calls back whenever `fd` takes bytes, and on errors too. A descriptor can't be watched in two ways at a time.
  [[nodiscard]] virtual SourcePtr on_writable(int fd, Callback callback) = 0;
  // Calls back once, when the process behind a pidfd has exited and can be reaped. Exits are delivered after output
  // that is already readable.
  [[nodiscard]] virtual SourcePtr on_exit(int pidfd, Callback callback) = 0;
  // Calls back once, `delay` from now.
  [[nodiscard]] virtual SourcePtr after(Duration delay, Callback callback) = 0;
  // Calls back on each delivery of one of the signals, before other pending work. The signals are blocked for the
  // process from now on; children get them unblocked (process_runner.hpp).
  [[nodiscard]] virtual SourcePtr on_signal(const std::vector<int>& signals, std::function<void(Signal)> callback) = 0;

  // Runs the callback in a later turn of the loop. The only function that other threads may call.
  virtual void post(Callback callback) = 0;

  // Time since some fixed point, as timers count it (CLOCK_MONOTONIC).
  virtual Duration now() const = 0;

  // Runs until quit() is called.
  virtual void run() = 0;
  virtual void quit() = 0;
};

// The real loop, on sd-event. Throws std::system_error.
std::unique_ptr<EventLoop> make_sd_event_loop();

}  // namespace launch
