// SPDX-License-Identifier: Apache-2.0
// Cleans up after this process if it is killed.
#pragma once

#include <sys/types.h>

#include <functional>

#include "base/files/unique_fd.hpp"

namespace tracing {

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
