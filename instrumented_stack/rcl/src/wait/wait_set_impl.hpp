// SPDX-License-Identifier: Apache-2.0
// The state of a wait set.
#pragma once

#include <cstddef>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl/rmw_entity.hpp"
#include "rcl/wait.h"
#include "rmw/rmw.h"

struct rcl_wait_set_impl_s {
  rmw_wait_set_t* rmw_wait_set = nullptr;
  // Storage of the public arrays.
  std::vector<const rcl_subscription_t*> subscriptions;
  std::vector<const rcl_guard_condition_t*> guard_conditions;
  std::vector<const rcl_timer_t*> timers;
  std::vector<const rcl_client_t*> clients;
  std::vector<const rcl_service_t*> services;
  std::vector<const rcl_event_t*> events;
  // How many entries of each are in use.
  size_t subscription_count = 0;
  size_t guard_condition_count = 0;
  size_t timer_count = 0;
  size_t client_count = 0;
  size_t service_count = 0;
  size_t event_count = 0;
  // The entities in rmw, for rmw_wait(). The guard conditions of the timers stand behind the other guard conditions.
  std::vector<void*> rmw_subscriptions;
  std::vector<void*> rmw_guard_conditions;
  std::vector<void*> rmw_clients;
  std::vector<void*> rmw_services;
  std::vector<void*> rmw_events;
};

namespace rcl {

inline rcl_ret_t check(const rcl_wait_set_t* wait_set) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(wait_set, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(wait_set->impl, "the wait set is not initialized", return RCL_RET_WAIT_SET_INVALID);
  return RCL_RET_OK;
}

}  // namespace rcl
