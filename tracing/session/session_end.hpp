// SPDX-License-Identifier: Apache-2.0
// The end of a session: stopped, written to the last byte, destroyed.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracing/session/tracer.hpp"

namespace tracing {

// Takes the time of the steps of a set-up or an end, from its making on.
class StepTimer {
 public:
  explicit StepTimer(std::vector<SessionStep>& steps) : steps_(steps) {}
  void finished(std::string name);

 private:
  std::vector<SessionStep>& steps_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// Throws TraceError.
std::optional<SessionSummary> find_session(const std::string& lttng_session_name);

// Stops the session and reads its losses once they are final, or as they are when give_up says so. A session that fails
// in this can't be used any more and is destroyed. Throws TraceError.
LossAccount stop_and_account(const std::string& lttng_session_name, const std::function<bool()>& give_up,
                             StepTimer& timer);

// Returns when nothing is left of the session, or give_up says so. Throws TraceError.
void destroy_session(const std::string& lttng_session_name, const std::function<bool()>& give_up);

}  // namespace tracing
