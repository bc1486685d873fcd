// SPDX-License-Identifier: Apache-2.0
// The names of the states of threads, as exports write them.
#pragma once

#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

// "running", "runnable", "blocked"
constexpr const char* state_name(ThreadState::State state) {
  switch (state) {
    case ThreadState::State::kRunning:
      return "running";
    case ThreadState::State::kRunnable:
      return "runnable";
    case ThreadState::State::kBlocked:
      break;
  }
  return "blocked";
}

}  // namespace tracing::timeline
