// SPDX-License-Identifier: Apache-2.0
// Waits for subscriptions, guard conditions, timers, clients, services and events.
//
// In each round call rcl_wait_set_clear(), add the entities, and call rcl_wait(). Then entries that are not ready are
// null. A wait set serves one thread at a time.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rcl/client.h"
#include "rcl/event.h"
#include "rcl/guard_condition.h"
#include "rcl/service.h"
#include "rcl/subscription.h"
#include "rcl/timer.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_wait_set_impl_s rcl_wait_set_impl_t;

typedef struct rcl_wait_set_s {
  const rcl_subscription_t** subscriptions;
  size_t size_of_subscriptions;
  const rcl_guard_condition_t** guard_conditions;
  size_t size_of_guard_conditions;
  const rcl_timer_t** timers;
  size_t size_of_timers;
  const rcl_client_t** clients;
  size_t size_of_clients;
  const rcl_service_t** services;
  size_t size_of_services;
  const rcl_event_t** events;
  size_t size_of_events;
  rcl_wait_set_impl_t* impl;
} rcl_wait_set_t;

rcl_wait_set_t rcl_get_zero_initialized_wait_set(void);

// Makes room for these numbers of entities.
rcl_ret_t rcl_wait_set_init(rcl_wait_set_t* wait_set, size_t number_of_subscriptions, size_t number_of_guard_conditions,
                            size_t number_of_timers, size_t number_of_clients, size_t number_of_services,
                            size_t number_of_events, rcl_context_t* context, rcl_allocator_t allocator);
rcl_ret_t rcl_wait_set_fini(rcl_wait_set_t* wait_set);
bool rcl_wait_set_is_valid(const rcl_wait_set_t* wait_set);

// Sets every entry to null.
rcl_ret_t rcl_wait_set_clear(rcl_wait_set_t* wait_set);

// Changes the numbers and clears the wait set. Room that is no longer needed is kept.
rcl_ret_t rcl_wait_set_resize(rcl_wait_set_t* wait_set, size_t subscriptions_size, size_t guard_conditions_size,
                              size_t timers_size, size_t clients_size, size_t services_size, size_t events_size);

// `index` (may be null) gets the position in the array. Returns RCL_RET_WAIT_SET_FULL if there is no room.
rcl_ret_t rcl_wait_set_add_subscription(rcl_wait_set_t* wait_set, const rcl_subscription_t* subscription,
                                        size_t* index);
rcl_ret_t rcl_wait_set_add_guard_condition(rcl_wait_set_t* wait_set, const rcl_guard_condition_t* guard_condition,
                                           size_t* index);
rcl_ret_t rcl_wait_set_add_timer(rcl_wait_set_t* wait_set, const rcl_timer_t* timer, size_t* index);
rcl_ret_t rcl_wait_set_add_client(rcl_wait_set_t* wait_set, const rcl_client_t* client, size_t* index);
rcl_ret_t rcl_wait_set_add_service(rcl_wait_set_t* wait_set, const rcl_service_t* service, size_t* index);
rcl_ret_t rcl_wait_set_add_event(rcl_wait_set_t* wait_set, const rcl_event_t* event, size_t* index);

// `timeout` is in ns: 0 does not block, a negative one waits forever. Returns RCL_RET_TIMEOUT if nothing became ready
// in time, and RCL_RET_WAIT_SET_EMPTY if the wait set has no entity.
rcl_ret_t rcl_wait(rcl_wait_set_t* wait_set, int64_t timeout);

#ifdef __cplusplus
}
#endif
