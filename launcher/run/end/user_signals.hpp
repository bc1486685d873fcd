// SPDX-License-Identifier: Apache-2.0
// The signals with which a user ends or stops a launch: which of them count, and whether it is the first.
//
// A signal that was ignored when the launcher started stays ignored if it is SIGHUP (`nohup launch`) or SIGTSTP. A
// signal that follows another one within a second is the same wish: a terminal that is closed sends SIGHUP twice,
// timeout(1) signals its command and then the group of the command.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace launch {

class UserSignals {
 public:
  struct Acts {
    std::function<bool()> intercept;  // true: the signal has told something else, and does not count
    std::function<void(const std::string& signal)> first;  // "ctrl-c (SIGINT)", "SIGTERM"
    std::function<void(int number, const std::string& signal)> again;
    std::function<void(const std::string& text)> tell;
  };

  // The references must outlive this object. The acts are called in the loop.
  UserSignals(EventLoop& loop, ProcessSupervisor& supervisor, Acts acts);

  // Called before the system stops by Ctrl-Z and after it goes on.
  void observe_suspension(std::function<void(bool stops)> observer) { on_suspension_ = std::move(observer); }

  // SIGHUP asks for something else than the end. To be called before listen().
  void take_hangup(std::function<void()> on_hangup) { on_hangup_ = std::move(on_hangup); }

  // Calls the acts from now on, as long as this object lives.
  void listen();

  // The end is asked for without a signal: what comes next is no first one. Returns false if a first one has been
  // there.
  bool count_as_first();

 private:
  void on_signal(EventLoop::Signal signal);
  // Stops the system, and returns when it shall go on.
  void suspend();

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  Acts acts_;
  std::function<void(bool stops)> on_suspension_;
  std::optional<Duration> counted_;  // when the last signal came that counted
  std::function<void()> on_hangup_;
  EventLoop::SourcePtr hangup_;
  EventLoop::SourcePtr ending_;
  EventLoop::SourcePtr stopping_;
};

}  // namespace launch
