// SPDX-License-Identifier: Apache-2.0
// What the control of traces throws.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace tracing {

// A trace could not be set up, or control over it was lost. what() is one line; remedy() says what to do, may be empty.
class TraceError : public std::runtime_error {
 public:
  explicit TraceError(const std::string& what, std::string remedy = {})
      : std::runtime_error(what), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

// `lttng-sessiond` is not installed: no trace is possible on this machine.
class SessionDaemonMissing : public TraceError {
 public:
  using TraceError::TraceError;
};

// The session daemon's consumer has ended, and the daemon starts no other one.
class ConsumerEnded : public TraceError {
 public:
  using TraceError::TraceError;
};

}  // namespace tracing
