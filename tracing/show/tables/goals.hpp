// SPDX-License-Identifier: Apache-2.0
// The goals of actions, from the calls of the services of which an action consists.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/model/timeline/timeline.hpp"

namespace tracing {

struct Goal {
  std::string action;
  timeline::Index client = timeline::kNone;  // nodes
  timeline::Index server = timeline::kNone;
  std::int64_t sent_ns = 0;
  std::int64_t answered_ns = 0;
  std::int64_t asked_ns = 0;
  std::int64_t result_ns = 0;
  timeline::Index goal_call = timeline::kNone;
  timeline::Index result_call = timeline::kNone;
};

// By begin. The client asks for a result in the callback of the answer. So a request for a result belongs to the last
// goal that was answered before.
std::vector<Goal> goals_of(const timeline::Timeline& timeline);

}  // namespace tracing
