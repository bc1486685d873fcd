// SPDX-License-Identifier: Apache-2.0
// The entity of rmw that stands for an entity of rcl in a wait: the `data` for rmw_wait().
#pragma once

#include "rcl/client.h"
#include "rcl/event.h"
#include "rcl/guard_condition.h"
#include "rcl/service.h"
#include "rcl/subscription.h"
#include "rcl/timer.h"
#include "rmw/rmw.h"

namespace rcl {

inline void* rmw_entity_of(const rcl_subscription_t* subscription) {
  return rcl_subscription_get_rmw_handle(subscription)->data;
}
inline void* rmw_entity_of(const rcl_guard_condition_t* guard_condition) {
  return rcl_guard_condition_get_rmw_handle(guard_condition)->data;
}
// The wait ends if another thread resets the timer, or if its clock jumps.
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
