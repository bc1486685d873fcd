// SPDX-License-Identifier: Apache-2.0
// How a session that a command records ends: by Enter, by a signal, or with this process.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <functional>

#include "base/files/unique_fd.hpp"

namespace tracing {

// While an object exists, SIGINT and SIGTERM of this thread do not end the process: they are kept until wait() or
// take_signal() asks for them. Make it before the program starts threads.
class EnterOrSignal {
 public:
  enum class Answer { kEnter, kInputEnded, kSignal };

  EnterOrSignal();
  ~EnterOrSignal();
  EnterOrSignal(const EnterOrSignal&) = delete;
  EnterOrSignal& operator=(const EnterOrSignal&) = delete;

  // Takes one line of stdin and no more, or one signal.
  Answer wait();

  // Takes one signal if one has come. Does not block.
  bool take_signal();

 private:
  sigset_t previous_mask_{};
  int signals_ = -1;
};

// Cleans up after this process if it is killed.
// Make it while the process has one thread. Another process waits until the guard ends. If this process ends before,
// even by kill -9, the other process calls `clean_up`. It has a session of its own, so a Ctrl-C does not reach it.
class SessionGuard {
 public:
  // Throws std::system_error.
  explicit SessionGuard(const std::function<void()>& clean_up);
  ~SessionGuard();
  SessionGuard(const SessionGuard&) = delete;
  SessionGuard& operator=(const SessionGuard&) = delete;

 private:
  launch::UniqueFd alive_;  // the other process reads from it
  pid_t waiting_ = -1;
};

}  // namespace tracing
