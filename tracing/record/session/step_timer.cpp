// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/step_timer.hpp"

#include <utility>

namespace tracing {

void StepTimer::finished(std::string name) {
  const auto now = std::chrono::steady_clock::now();
  steps_.push_back({std::move(name), now - std::exchange(begin_, now)});
}

}  // namespace tracing
