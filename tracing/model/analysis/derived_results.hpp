// SPDX-License-Identifier: Apache-2.0
// Results that follow from other results.
#pragma once

#include <vector>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// An action is three services and two topics with names of its own: NAME/_action/send_goal, …/get_result,
// …/cancel_goal, …/feedback, …/status. One result for each action and client.
std::vector<ActionResult> action_results(const Ros2Results& results);

// Whether the service belongs to an action.
bool is_of_action(const std::string& service);

}  // namespace tracing
