#include "rcl/wait.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "rcl/error_handling.h"
#include "rcl/wait_restore.h"
#include "rmw/rmw.h"

namespace {

// The entities of one kind that were kept, and what rmw knows them by.
template <typename Entity>
struct Kept {
  std::vector<const Entity*> entities;
  std::vector<void*> rmw_entities;
};

}  // namespace

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
  Kept<rcl_subscription_t> kept_subscriptions;
  Kept<rcl_guard_condition_t> kept_guard_conditions;
  Kept<rcl_timer_t> kept_timers;  // rmw does not know them
  Kept<rcl_client_t> kept_clients;
  Kept<rcl_service_t> kept_services;
  Kept<rcl_event_t> kept_events;
};

namespace {

constexpr int64_t kForever = std::numeric_limits<int64_t>::max();

rcl_ret_t check(const rcl_wait_set_t* wait_set) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(wait_set, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(wait_set->impl, "the wait set is not initialized", return RCL_RET_WAIT_SET_INVALID);
  return RCL_RET_OK;
}

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

// Nanoseconds until the first timer is due, `kForever` without one; 0 or less if one is due already.
rcl_ret_t time_until_first_timer(const rcl_wait_set_impl_t& impl, int64_t& time) {
  time = kForever;
  for (size_t i = 0; i < impl.timer_count; ++i) {
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

void* rmw_entity_of(const rcl_subscription_t* subscription) {
  return rcl_subscription_get_rmw_handle(subscription)->data;
}
void* rmw_entity_of(const rcl_guard_condition_t* guard_condition) {
  return rcl_guard_condition_get_rmw_handle(guard_condition)->data;
}
void* rmw_entity_of(const rcl_client_t* client) {
  return rcl_client_get_rmw_handle(client)->data;
}
void* rmw_entity_of(const rcl_service_t* service) {
  return rcl_service_get_rmw_handle(service)->data;
}
void* rmw_entity_of(const rcl_event_t* event) {
  return rcl_event_get_rmw_handle(event)->data;
}

template <typename Entity>
void collect(const std::vector<const Entity*>& entities, size_t count, const Kept<Entity>& kept,
             std::vector<void*>& rmw_entities) {
  rmw_entities = kept.rmw_entities;
  for (size_t i = kept.rmw_entities.size(); i < count; ++i) {
    rmw_entities.push_back(rmw_entity_of(entities[i]));
  }
}

void collect_rmw_entities(rcl_wait_set_impl_t& impl) {
  collect(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions, impl.rmw_subscriptions);
  collect(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions, impl.rmw_guard_conditions);
  // A timer that is reset from another thread, or whose clock jumps, ends the wait.
  for (size_t i = 0; i < impl.timer_count; ++i) {
    impl.rmw_guard_conditions.push_back(rmw_entity_of(rcl_timer_get_guard_condition(impl.timers[i])));
  }
  collect(impl.clients, impl.client_count, impl.kept_clients, impl.rmw_clients);
  collect(impl.services, impl.service_count, impl.kept_services, impl.rmw_services);
  collect(impl.events, impl.event_count, impl.kept_events, impl.rmw_events);
}

template <typename Entity>
void keep(const std::vector<const Entity*>& entities, size_t count, Kept<Entity>& kept) {
  kept.entities.assign(entities.begin(), entities.begin() + static_cast<std::ptrdiff_t>(count));
  kept.rmw_entities.clear();
  if constexpr (!std::is_same_v<Entity, rcl_timer_t>) {
    for (const Entity* entity : kept.entities) {
      kept.rmw_entities.push_back(rmw_entity_of(entity));
    }
  }
}

template <typename Entity>
void restore(std::vector<const Entity*>& entities, size_t& count, const Kept<Entity>& kept) {
  std::fill(std::copy(kept.entities.begin(), kept.entities.end(), entities.begin()), entities.end(), nullptr);
  count = kept.entities.size();
}

template <typename Entity>
void forget(Kept<Entity>& kept) {
  kept.entities.clear();
  kept.rmw_entities.clear();
}

// Nulls the entries for which rmw has nulled its own.
template <typename Entity>
void keep_ready(std::vector<const Entity*>& entities, size_t count, const std::vector<void*>& rmw_entities) {
  for (size_t i = 0; i < count; ++i) {
    entities[i] = rmw_entities[i] == nullptr ? nullptr : entities[i];
  }
}

// Nulls the entries that are not ready. False if no timer is.
rcl_ret_t keep_ready(rcl_wait_set_impl_t& impl, bool& any_timer) {
  keep_ready(impl.subscriptions, impl.subscription_count, impl.rmw_subscriptions);
  keep_ready(impl.guard_conditions, impl.guard_condition_count, impl.rmw_guard_conditions);
  keep_ready(impl.clients, impl.client_count, impl.rmw_clients);
  keep_ready(impl.services, impl.service_count, impl.rmw_services);
  keep_ready(impl.events, impl.event_count, impl.rmw_events);
  any_timer = false;
  for (size_t i = 0; i < impl.timer_count; ++i) {
    bool is_ready = false;
    if (const rcl_ret_t result = rcl_timer_is_ready(impl.timers[i], &is_ready); result != RCL_RET_OK) {
      return result;
    }
    if (!is_ready) {
      impl.timers[i] = nullptr;
    }
    any_timer |= is_ready;
  }
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
  impl.has_kept = false;
  forget(impl.kept_subscriptions);
  forget(impl.kept_guard_conditions);
  forget(impl.kept_timers);
  forget(impl.kept_clients);
  forget(impl.kept_services);
  forget(impl.kept_events);
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_keep(rcl_wait_set_t* wait_set) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  rcl_wait_set_impl_t& impl = *wait_set->impl;
  keep(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions);
  keep(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions);
  keep(impl.timers, impl.timer_count, impl.kept_timers);
  keep(impl.clients, impl.client_count, impl.kept_clients);
  keep(impl.services, impl.service_count, impl.kept_services);
  keep(impl.events, impl.event_count, impl.kept_events);
  impl.has_kept = true;
  return RCL_RET_OK;
}

rcl_ret_t rcl_wait_set_restore(rcl_wait_set_t* wait_set) {
  if (const rcl_ret_t result = check(wait_set); result != RCL_RET_OK) {
    return result;
  }
  rcl_wait_set_impl_t& impl = *wait_set->impl;
  if (!impl.has_kept) {
    RCL_SET_ERROR_MSG("the wait set has kept nothing");
    return RCL_RET_WAIT_SET_EMPTY;
  }
  restore(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions);
  restore(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions);
  restore(impl.timers, impl.timer_count, impl.kept_timers);
  restore(impl.clients, impl.client_count, impl.kept_clients);
  restore(impl.services, impl.service_count, impl.kept_services);
  restore(impl.events, impl.event_count, impl.kept_events);
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
  bool any_timer = false;
  if (const rcl_ret_t ready_result = keep_ready(impl, any_timer); ready_result != RCL_RET_OK) {
    return ready_result;
  }
  // The end of the time that a timer asked for is no timeout of the caller's.
  return result == RMW_RET_TIMEOUT && !any_timer && limit <= until_timer ? RCL_RET_TIMEOUT : RCL_RET_OK;
}
