// SPDX-License-Identifier: Apache-2.0
// Takes the time of the steps of a set-up or an end.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "tracing/record/account/session_step.hpp"

namespace tracing {

// The first step begins when the timer is made, each other one when the step before has finished.
class StepTimer {
 public:
  explicit StepTimer(std::vector<SessionStep>& steps) : steps_(steps) {}
  void finished(std::string name);

 private:
  std::vector<SessionStep>& steps_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace tracing
