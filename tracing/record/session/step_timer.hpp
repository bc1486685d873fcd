// SPDX-License-Identifier: Apache-2.0
// Takes the time of the steps of a set-up or an end.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tracing/record/account/loss_account.hpp"

namespace tracing {

// The first step begins when the timer is made, each other one when the step before has finished.
class StepTimer {
 public:
  explicit StepTimer(std::vector<SessionStep>& steps) : steps_(steps) {}
  void finished(std::string name) {
    const auto now = std::chrono::steady_clock::now();
    steps_.push_back({std::move(name), now - std::exchange(begin_, now)});
  }

 private:
  std::vector<SessionStep>& steps_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace tracing
