// SPDX-License-Identifier: Apache-2.0
// rcl_wait(): the wait of rmw, and timers.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "wait/wait_set_impl.hpp"

using rcl::check;
using rcl::rmw_entity_of;

namespace {

constexpr int64_t kForever = std::numeric_limits<int64_t>::max();

// Nanoseconds until the first timer is due, `kForever` without one; 0 or less if one is due already.
rcl_ret_t time_until_first_timer(const rcl_wait_set_impl_t& impl, int64_t& time) {
  time = kForever;
  for (size_t i = 0; i < impl.timer_count; ++i) {
    if (impl.timers[i] == nullptr) {
      continue;
    }
    int64_t until_next = 0;
    const rcl_ret_t result = rcl_timer_get_time_until_next_call(impl.timers[i], &until_next);
    if (result == RCL_RET_TIMER_CANCELED) {
      continue;
    }
    if (result != RCL_RET_OK) {
      return result;
    }
    time = std::min(time, until_next);
  }
  return RCL_RET_OK;
}

// An entry is null if the wait before did not find it ready and the wait set was not cleared since.
template <typename Entity>
void* rmw_entity_or_null(const Entity* entity) {
  return entity == nullptr ? nullptr : rmw_entity_of(entity);
}

template <typename Entity>
void collect(const std::vector<const Entity*>& entities, size_t count, std::vector<void*>& rmw_entities) {
  rmw_entities.clear();
  for (size_t i = 0; i < count; ++i) {
    rmw_entities.push_back(rmw_entity_or_null(entities[i]));
  }
}

void collect_rmw_entities(rcl_wait_set_impl_t& impl) {
  collect(impl.subscriptions, impl.subscription_count, impl.rmw_subscriptions);
  collect(impl.guard_conditions, impl.guard_condition_count, impl.rmw_guard_conditions);
  for (size_t i = 0; i < impl.timer_count; ++i) {
    impl.rmw_guard_conditions.push_back(rmw_entity_or_null(impl.timers[i]));
  }
  collect(impl.clients, impl.client_count, impl.rmw_clients);
  collect(impl.services, impl.service_count, impl.rmw_services);
  collect(impl.events, impl.event_count, impl.rmw_events);
}

// Nulls the entries for which rmw has nulled its own.
template <typename Entity>
void keep_ready(std::vector<const Entity*>& entities, size_t count, const std::vector<void*>& rmw_entities) {
  for (size_t i = 0; i < count; ++i) {
    if (rmw_entities[i] == nullptr) {
      entities[i] = nullptr;
    }
  }
}

void keep_ready(rcl_wait_set_impl_t& impl) {
  keep_ready(impl.subscriptions, impl.subscription_count, impl.rmw_subscriptions);
  keep_ready(impl.guard_conditions, impl.guard_condition_count, impl.rmw_guard_conditions);
  keep_ready(impl.clients, impl.client_count, impl.rmw_clients);
  keep_ready(impl.services, impl.service_count, impl.rmw_services);
  keep_ready(impl.events, impl.event_count, impl.rmw_events);
}

// Nulls the entries of timers that are not due. `any` tells whether one is.
rcl_ret_t keep_ready_timers(rcl_wait_set_impl_t& impl, bool& any) {
  any = false;
  for (size_t i = 0; i < impl.timer_count; ++i) {
    if (impl.timers[i] == nullptr) {
      continue;
    }
    bool is_ready = false;
    if (const rcl_ret_t result = rcl_timer_is_ready(impl.timers[i], &is_ready); result != RCL_RET_OK) {
      return result;
    }
    if (!is_ready) {
      impl.timers[i] = nullptr;
    }
    any |= is_ready;
  }
  return RCL_RET_OK;
}

}  // namespace

rcl_ret_t rcl_wait(rcl_wait_set_t* wait_set, int64_t timeout) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  rcl_wait_set_impl_t& impl = *wait_set->impl;
  if (impl.subscription_count + impl.guard_condition_count + impl.timer_count + impl.client_count + impl.service_count +
          impl.event_count ==
      0) {
    RCL_SET_ERROR_MSG("there is nothing to wait for in the wait set");
    return RCL_RET_WAIT_SET_EMPTY;
  }
  int64_t until_timer = kForever;
  if (const rcl_ret_t result = time_until_first_timer(impl, until_timer); result != RCL_RET_OK) {
    return result;
  }
  const int64_t limit = timeout < 0 ? kForever : timeout;
  const int64_t wait_time = std::max<int64_t>(0, std::min(limit, until_timer));
  const rmw_time_t rmw_timeout = rmw_time_from_nsec(wait_time);

  collect_rmw_entities(impl);
  rmw_subscriptions_t subscriptions{impl.rmw_subscriptions.size(), impl.rmw_subscriptions.data()};
  rmw_guard_conditions_t guard_conditions{impl.rmw_guard_conditions.size(), impl.rmw_guard_conditions.data()};
  rmw_services_t services{impl.rmw_services.size(), impl.rmw_services.data()};
  rmw_clients_t clients{impl.rmw_clients.size(), impl.rmw_clients.data()};
  rmw_events_t events{impl.rmw_events.size(), impl.rmw_events.data()};
  const rmw_ret_t result = rmw_wait(&subscriptions, &guard_conditions, &services, &clients, &events, impl.rmw_wait_set,
                                    wait_time == kForever ? nullptr : &rmw_timeout);
  if (result != RMW_RET_OK && result != RMW_RET_TIMEOUT) {
    return result;
  }
  keep_ready(impl);
  bool any_timer = false;
  if (const rcl_ret_t timer_result = keep_ready_timers(impl, any_timer); timer_result != RCL_RET_OK) {
    return timer_result;
  }
  // The end of the time that a timer asked for is no timeout of the caller's.
  return result == RMW_RET_TIMEOUT && !any_timer && limit <= until_timer ? RCL_RET_TIMEOUT : RCL_RET_OK;
}
