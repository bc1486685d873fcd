// SPDX-License-Identifier: Apache-2.0
// Adds a guard condition to a wait set of rcl, for waitables.
#pragma once

#include <rcl/wait.h>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/guard_condition.hpp"

namespace rclcpp::detail {

// Throws exceptions::RCLError, for example if the wait set is full.
inline void add_guard_condition_to_rcl_wait_set(rcl_wait_set_t& wait_set, const GuardCondition& guard_condition) {
  require_ok(rcl_wait_set_add_guard_condition(&wait_set, &guard_condition.get_rcl_guard_condition(), nullptr),
             "failed to add guard condition to wait set");
}

}  // namespace rclcpp::detail
