// SPDX-License-Identifier: Apache-2.0
// The state of a wait set.
#pragma once

#include <cstddef>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl/wait.h"
#include "rcl/wait_restore.h"
#include "rmw/rmw.h"
#include "time/timer_queue.hpp"

namespace rcl {

// The entities of one kind that were kept, and what rmw knows them by.
template <typename Entity>
struct Kept {
  std::vector<const Entity*> entities;
  std::vector<void*> rmw_entities;
  std::vector<size_t> left;  // which of them the last wait has left in the public array

  rcl_wait_set_left_indices_t left_indices() const { return {left.data(), left.size()}; }
};

}  // namespace rcl

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
  // What rmw waits for: the same entities, then the guard conditions of the timers.
  std::vector<void*> rmw_subscriptions;
  std::vector<void*> rmw_guard_conditions;
  std::vector<void*> rmw_clients;
  std::vector<void*> rmw_services;
  std::vector<void*> rmw_events;
  // Of rcl_wait_set_keep(): the first ones of each kind, whenever they are in use.
  bool has_kept = false;
  // As long as nothing but these and `further` is waited for, rmw knows them, and of the public arrays only the entries
  // that a wait has left are touched.
  bool rmw_knows_kept = false;
  bool are_entries_null = false;          // of the kept ones, after rcl_wait_set_restore()
  std::vector<const void*> further;       // rmw's of what is added to the kept ones, kind after kind
  std::vector<const void*> last_further;  // in the last wait
  std::vector<const void*> taken_out;     // of the public arrays, while they are waited for again
  rcl_wait_set_left_t left{};             // by the last wait
  rcl::Kept<rcl_subscription_t> kept_subscriptions;
  rcl::Kept<rcl_guard_condition_t> kept_guard_conditions;
  rcl::Kept<rcl_timer_t> kept_timers;  // rmw does not know them
  rcl::TimerQueue timer_queue;         // of the same
  rcl::Kept<rcl_client_t> kept_clients;
  rcl::Kept<rcl_service_t> kept_services;
  rcl::Kept<rcl_event_t> kept_events;
};

namespace rcl {

inline rcl_ret_t check(const rcl_wait_set_t* wait_set) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(wait_set, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(wait_set->impl, "the wait set is not initialized", return RCL_RET_WAIT_SET_INVALID);
  return RCL_RET_OK;
}

inline void* rmw_entity_of(const rcl_subscription_t* subscription) {
  return rcl_subscription_get_rmw_handle(subscription)->data;
}
inline void* rmw_entity_of(const rcl_guard_condition_t* guard_condition) {
  return rcl_guard_condition_get_rmw_handle(guard_condition)->data;
}
// A timer that is reset from another thread, or whose clock jumps, ends the wait.
inline void* rmw_entity_of(const rcl_timer_t* timer) {
  return rmw_entity_of(rcl_timer_get_guard_condition(timer));
}
inline void* rmw_entity_of(const rcl_client_t* client) {
  return rcl_client_get_rmw_handle(client)->data;
}
inline void* rmw_entity_of(const rcl_service_t* service) {
  return rcl_service_get_rmw_handle(service)->data;
}
inline void* rmw_entity_of(const rcl_event_t* event) {
  return rcl_event_get_rmw_handle(event)->data;
}

}  // namespace rcl
