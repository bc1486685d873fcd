// SPDX-License-Identifier: Apache-2.0
// The content of wait sets.
#include <algorithm>
#include <vector>

#include "wait/wait_set_impl.hpp"

using rcl::check;

namespace {

template <typename Entity>
rcl_ret_t add(const rcl_wait_set_t* wait_set, std::vector<const Entity*> rcl_wait_set_impl_s::*storage,
              size_t rcl_wait_set_impl_s::*count, const Entity* entity, size_t* index) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(entity, RCL_RET_INVALID_ARGUMENT);
  auto& entries = wait_set->impl->*storage;
  size_t& used = wait_set->impl->*count;
  if (used == entries.size()) {
    RCL_SET_ERROR_MSG("the wait set has no more room for entities of this kind");
    return RCL_RET_WAIT_SET_FULL;
  }
  if (index != nullptr) {
    *index = used;
  }
  entries[used++] = entity;
  return RCL_RET_OK;
}

}  // namespace

rcl_wait_set_t rcl_get_zero_initialized_wait_set(void) {
  return {};
}

rcl_ret_t rcl_wait_set_init(rcl_wait_set_t* wait_set, size_t number_of_subscriptions, size_t number_of_guard_conditions,
                            size_t number_of_timers, size_t number_of_clients, size_t number_of_services,
                            size_t number_of_events, rcl_context_t* context, rcl_allocator_t) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(wait_set, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  if (wait_set->impl != nullptr) {
    RCL_SET_ERROR_MSG("the wait set is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (!rcl_context_is_valid(context)) {
    RCL_SET_ERROR_MSG("a wait set needs a context that is initialized and not shut down");
    return RCL_RET_NOT_INIT;
  }
  rmw_wait_set_t* handle = rmw_create_wait_set(rcl_context_get_rmw_context(context),
                                               number_of_subscriptions + number_of_guard_conditions + number_of_timers +
                                                   number_of_clients + number_of_services + number_of_events);
  if (handle == nullptr) {
    return RCL_RET_ERROR;
  }
  wait_set->impl = new rcl_wait_set_impl_s;
  wait_set->impl->rmw_wait_set = handle;
  const rcl_ret_t result =
      rcl_wait_set_resize(wait_set, number_of_subscriptions, number_of_guard_conditions, number_of_timers,
                          number_of_clients, number_of_services, number_of_events);
  if (result != RCL_RET_OK) {
    (void)rcl_wait_set_fini(wait_set);
  }
  return result;
}

rcl_ret_t rcl_wait_set_fini(rcl_wait_set_t* wait_set) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(wait_set, RCL_RET_INVALID_ARGUMENT);
  rmw_ret_t result = RMW_RET_OK;
  if (wait_set->impl != nullptr) {
    result = rmw_destroy_wait_set(wait_set->impl->rmw_wait_set);
    delete wait_set->impl;
    *wait_set = rcl_get_zero_initialized_wait_set();
  }
  return result;
}

bool rcl_wait_set_is_valid(const rcl_wait_set_t* wait_set) {
  return wait_set != nullptr && wait_set->impl != nullptr;
}

rcl_ret_t rcl_wait_set_clear(rcl_wait_set_t* wait_set) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  rcl_wait_set_impl_t& impl = *wait_set->impl;
  std::fill(impl.subscriptions.begin(), impl.subscriptions.end(), nullptr);
  std::fill(impl.guard_conditions.begin(), impl.guard_conditions.end(), nullptr);
  std::fill(impl.timers.begin(), impl.timers.end(), nullptr);
  std::fill(impl.clients.begin(), impl.clients.end(), nullptr);
  std::fill(impl.services.begin(), impl.services.end(), nullptr);
  std::fill(impl.events.begin(), impl.events.end(), nullptr);
  impl.subscription_count = impl.guard_condition_count = impl.timer_count = 0;
  impl.client_count = impl.service_count = impl.event_count = 0;
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_resize(rcl_wait_set_t* wait_set, size_t subscriptions_size, size_t guard_conditions_size,
                              size_t timers_size, size_t clients_size, size_t services_size, size_t events_size) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  rcl_wait_set_impl_t& impl = *wait_set->impl;
  impl.subscriptions.resize(subscriptions_size);
  impl.guard_conditions.resize(guard_conditions_size);
  impl.timers.resize(timers_size);
  wait_set->subscriptions = impl.subscriptions.data();
  wait_set->size_of_subscriptions = subscriptions_size;
  wait_set->guard_conditions = impl.guard_conditions.data();
  wait_set->size_of_guard_conditions = guard_conditions_size;
  wait_set->timers = impl.timers.data();
  wait_set->size_of_timers = timers_size;
  impl.clients.resize(clients_size);
  wait_set->clients = impl.clients.data();
  wait_set->size_of_clients = clients_size;
  impl.services.resize(services_size);
  wait_set->services = impl.services.data();
  wait_set->size_of_services = services_size;
  impl.events.resize(events_size);
  wait_set->events = impl.events.data();
  wait_set->size_of_events = events_size;
  return rcl_wait_set_clear(wait_set);
}

rcl_ret_t rcl_wait_set_add_subscription(rcl_wait_set_t* wait_set, const rcl_subscription_t* subscription,
                                        size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::subscriptions, &rcl_wait_set_impl_s::subscription_count, subscription,
             index);
}

rcl_ret_t rcl_wait_set_add_guard_condition(rcl_wait_set_t* wait_set, const rcl_guard_condition_t* guard_condition,
                                           size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::guard_conditions, &rcl_wait_set_impl_s::guard_condition_count,
             guard_condition, index);
}

rcl_ret_t rcl_wait_set_add_timer(rcl_wait_set_t* wait_set, const rcl_timer_t* timer, size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::timers, &rcl_wait_set_impl_s::timer_count, timer, index);
}

rcl_ret_t rcl_wait_set_add_client(rcl_wait_set_t* wait_set, const rcl_client_t* client, size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::clients, &rcl_wait_set_impl_s::client_count, client, index);
}

rcl_ret_t rcl_wait_set_add_service(rcl_wait_set_t* wait_set, const rcl_service_t* service, size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::services, &rcl_wait_set_impl_s::service_count, service, index);
}

rcl_ret_t rcl_wait_set_add_event(rcl_wait_set_t* wait_set, const rcl_event_t* event, size_t* index) {
  return add(wait_set, &rcl_wait_set_impl_s::events, &rcl_wait_set_impl_s::event_count, event, index);
}
