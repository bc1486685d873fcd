// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "rmw/wait_again.h"
#include "wait/wait_set_impl.hpp"

using rcl::check;
using rcl::Kept;
using rcl::rmw_entity_of;

namespace {

constexpr int64_t kForever = rcl::TimerQueue::kNever;

// Nanoseconds until the first timer is due, `kForever` without one; 0 or less if one is due already.
rcl_ret_t time_until_first_timer(rcl_wait_set_impl_t& impl, int64_t& time) {
  if (const rcl_ret_t result = impl.timer_queue.time_until_first(time); result != RCL_RET_OK) {
    return result;
  }
  for (size_t i = impl.kept_timers.entities.size(); i < impl.timer_count; ++i) {
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
  for (size_t i = 0; i < impl.timer_count; ++i) {
    impl.rmw_guard_conditions.push_back(rmw_entity_of(impl.timers[i]));
  }
  collect(impl.clients, impl.client_count, impl.kept_clients, impl.rmw_clients);
  collect(impl.services, impl.service_count, impl.kept_services, impl.rmw_services);
  collect(impl.events, impl.event_count, impl.kept_events, impl.rmw_events);
}

template <typename Entity>
void fill_in(std::vector<const Entity*>& entities, const Kept<Entity>& kept) {
  std::copy(kept.entities.begin(), kept.entities.end(), entities.begin());
}

template <typename Entity>
void append_further(const std::vector<const Entity*>& entities, size_t count, const Kept<Entity>& kept,
                    std::vector<const void*>& further) {
  for (size_t i = kept.entities.size(); i < count; ++i) {
    further.push_back(rmw_entity_of(entities[i]));
  }
  further.push_back(nullptr);  // the end of the kind
}

void collect_further(rcl_wait_set_impl_t& impl) {
  impl.further.clear();
  append_further(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions, impl.further);
  append_further(impl.services, impl.service_count, impl.kept_services, impl.further);
  append_further(impl.clients, impl.client_count, impl.kept_clients, impl.further);
  append_further(impl.events, impl.event_count, impl.kept_events, impl.further);
  append_further(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions, impl.further);
  append_further(impl.timers, impl.timer_count, impl.kept_timers, impl.further);
}

template <typename Entity>
void take_out_further(std::vector<const Entity*>& entities, size_t count, const Kept<Entity>& kept,
                      std::vector<const void*>& taken_out) {
  for (size_t i = kept.entities.size(); i < count; ++i) {
    taken_out.push_back(std::exchange(entities[i], nullptr));
  }
}

// All entries are null then, but those of timers that were added to the kept ones.
void take_out_further(rcl_wait_set_impl_t& impl) {
  impl.taken_out.clear();
  take_out_further(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions, impl.taken_out);
  take_out_further(impl.services, impl.service_count, impl.kept_services, impl.taken_out);
  take_out_further(impl.clients, impl.client_count, impl.kept_clients, impl.taken_out);
  take_out_further(impl.events, impl.event_count, impl.kept_events, impl.taken_out);
  take_out_further(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions, impl.taken_out);
}

// Nulls the entries for which rmw has nulled its own.
template <typename Entity>
void keep_ready(std::vector<const Entity*>& entities, size_t count, const std::vector<void*>& rmw_entities,
                Kept<Entity>& kept, rcl_wait_set_left_indices_t& left) {
  kept.left.clear();
  for (size_t i = 0; i < count; ++i) {
    if (rmw_entities[i] == nullptr) {
      entities[i] = nullptr;
    } else if (i < kept.entities.size()) {
      kept.left.push_back(i);
    }
  }
  left = kept.left_indices();
}

void keep_ready(rcl_wait_set_impl_t& impl) {
  auto& [timers, subscriptions, services, clients, events] = impl.left;
  keep_ready(impl.subscriptions, impl.subscription_count, impl.rmw_subscriptions, impl.kept_subscriptions,
             subscriptions);
  keep_ready(impl.services, impl.service_count, impl.rmw_services, impl.kept_services, services);
  keep_ready(impl.clients, impl.client_count, impl.rmw_clients, impl.kept_clients, clients);
  keep_ready(impl.events, impl.event_count, impl.rmw_events, impl.kept_events, events);
  rcl_wait_set_left_indices_t guard_conditions;
  keep_ready(impl.guard_conditions, impl.guard_condition_count, impl.rmw_guard_conditions, impl.kept_guard_conditions,
             guard_conditions);
}

// What is ready of a wait for what rmw knows: indices, counted through all kinds.
class Ready {
 public:
  Ready(const size_t* begin, size_t count, const std::vector<const void*>& taken_out)
      : next_(begin), end_(begin + count), taken_out_(taken_out.begin()) {}

  // Puts the ready ones of the next kind into the array, whose entries are null. False when none is left for the
  // others.
  template <typename Entity>
  bool fill_in(std::vector<const Entity*>& entities, size_t count, Kept<Entity>& kept,
               rcl_wait_set_left_indices_t* left) {
    const size_t kept_count = kept.entities.size();
    for (; next_ != end_ && *next_ - first_ < count; ++next_) {
      const size_t i = *next_ - first_;
      if (i < kept_count) {
        kept.left.push_back(i);
        entities[i] = kept.entities[i];
      } else {
        entities[i] = static_cast<const Entity*>(taken_out_[static_cast<std::ptrdiff_t>(i - kept_count)]);
      }
    }
    if (left != nullptr) {
      *left = kept.left_indices();
    }
    first_ += count;
    taken_out_ += static_cast<std::ptrdiff_t>(count - kept_count);
    return next_ != end_;
  }

 private:
  const size_t* next_;
  const size_t* end_;
  std::vector<const void*>::const_iterator taken_out_;  // of the kind
  size_t first_ = 0;                                    // of the kind
};

[[gnu::hot]] void fill_in_ready(rcl_wait_set_impl_t& impl, const size_t* indices, size_t count) {
  Ready ready(indices, count, impl.taken_out);
  // Most waits end with a message: what is of the other kinds is not touched then.
  const bool has_timers =
      count != 0 &&
      ready.fill_in(impl.subscriptions, impl.subscription_count, impl.kept_subscriptions, &impl.left.subscriptions) &&
      ready.fill_in(impl.services, impl.service_count, impl.kept_services, &impl.left.services) &&
      ready.fill_in(impl.clients, impl.client_count, impl.kept_clients, &impl.left.clients) &&
      ready.fill_in(impl.events, impl.event_count, impl.kept_events, &impl.left.events) &&
      ready.fill_in(impl.guard_conditions, impl.guard_condition_count, impl.kept_guard_conditions, nullptr);
  if (has_timers) {
    impl.timer_queue.forget_times();
  }
}

// Nulls the entries of timers that are not ready, which those of the kept ones may be already. False if none is.
rcl_ret_t keep_ready_timers(rcl_wait_set_impl_t& impl, bool are_entries_null, bool& any_timer) {
  any_timer = false;
  if (impl.timer_count == 0) {
    return RCL_RET_OK;
  }
  auto& [kept, rmw_entities, left] = impl.kept_timers;
  left.clear();
  if (const rcl_ret_t result = impl.timer_queue.append_due(left); result != RCL_RET_OK) {
    return result;
  }
  if (!are_entries_null) {
    std::fill_n(impl.timers.begin(), kept.size(), nullptr);
  }
  for (const size_t i : left) {
    impl.timers[i] = kept[i];
  }
  impl.left.timers = impl.kept_timers.left_indices();
  any_timer = !left.empty();
  for (size_t i = kept.size(); i < impl.timer_count; ++i) {
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

rmw_ret_t wait_for_all(rcl_wait_set_impl_t& impl, const rmw_time_t* timeout) {
  if (impl.are_entries_null) {
    fill_in(impl.subscriptions, impl.kept_subscriptions);
    fill_in(impl.guard_conditions, impl.kept_guard_conditions);
    fill_in(impl.timers, impl.kept_timers);
    fill_in(impl.clients, impl.kept_clients);
    fill_in(impl.services, impl.kept_services);
    fill_in(impl.events, impl.kept_events);
  }
  collect_rmw_entities(impl);
  rmw_subscriptions_t subscriptions{impl.rmw_subscriptions.size(), impl.rmw_subscriptions.data()};
  rmw_guard_conditions_t guard_conditions{impl.rmw_guard_conditions.size(), impl.rmw_guard_conditions.data()};
  rmw_services_t services{impl.rmw_services.size(), impl.rmw_services.data()};
  rmw_clients_t clients{impl.rmw_clients.size(), impl.rmw_clients.data()};
  rmw_events_t events{impl.rmw_events.size(), impl.rmw_events.data()};
  const rmw_ret_t result =
      rmw_wait(&subscriptions, &guard_conditions, &services, &clients, &events, impl.rmw_wait_set, timeout);
  if (result == RMW_RET_OK || result == RMW_RET_TIMEOUT) {
    keep_ready(impl);
    impl.timer_queue.forget_times();
  }
  return result;
}

rmw_ret_t wait_again(rcl_wait_set_impl_t& impl, const rmw_time_t* timeout) {
  take_out_further(impl);
  const size_t* ready = nullptr;
  size_t count = 0;
  const rmw_ret_t result = rmw_wait_again(impl.rmw_wait_set, timeout, &ready, &count);
  if (result == RMW_RET_OK || result == RMW_RET_TIMEOUT) {
    fill_in_ready(impl, ready, count);
  }
  return result;
}

}  // namespace

[[gnu::hot]] rcl_ret_t rcl_wait(rcl_wait_set_t* wait_set, int64_t timeout) {
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

  if (impl.has_kept) {
    collect_further(impl);
  }
  const bool again = impl.are_entries_null && impl.further == impl.last_further;
  const rmw_time_t* const deadline = wait_time == kForever ? nullptr : &rmw_timeout;
  // Until this wait has gone well, nothing is known.
  const bool has_kept = impl.has_kept;
  impl.rmw_knows_kept = false;
  impl.left = {};
  const rmw_ret_t result = again ? wait_again(impl, deadline) : wait_for_all(impl, deadline);
  impl.are_entries_null = false;
  if (result != RMW_RET_OK && result != RMW_RET_TIMEOUT) {
    return result;
  }
  impl.rmw_knows_kept = has_kept;
  impl.last_further.swap(impl.further);
  bool any_timer = false;
  if (const rcl_ret_t timer_result = keep_ready_timers(impl, again, any_timer); timer_result != RCL_RET_OK) {
    return timer_result;
  }
  // The end of the time that a timer asked for is no timeout of the caller's.
  return result == RMW_RET_TIMEOUT && !any_timer && limit <= until_timer ? RCL_RET_TIMEOUT : RCL_RET_OK;
}
