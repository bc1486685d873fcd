// SPDX-License-Identifier: Apache-2.0
// Guard conditions, wait sets and rmw_wait().
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <new>
#include <span>
#include <vector>

#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rmw/waiter.hpp"
#include "types/identifier.hpp"
#include "wait/waitable.hpp"

using rmw_fastrtps::GuardCondition;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::Waitable;
using rmw_fastrtps::Waiter;

namespace {

// A longer time is no limit.
constexpr uint64_t kForeverSeconds = 1000000000;  // about 31 years

// Negative: no limit.
std::chrono::nanoseconds to_nanoseconds(const rmw_time_t* timeout) {
  if (timeout == nullptr || timeout->sec >= kForeverSeconds) {
    return std::chrono::nanoseconds(-1);
  }
  return std::chrono::seconds(timeout->sec) + std::chrono::nanoseconds(timeout->nsec);
}

// The state behind rmw_wait_set_t.
struct WaitSet {
  Waiter waiter;
  // Of the current call of rmw_wait().
  std::vector<void*> entities;
  std::vector<std::size_t> ready;  // positions
};

// The arrays of one call of rmw_wait(). Their null entries are left out and not counted.
class Entities {
 public:
  Entities(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guard_conditions, rmw_services_t* services,
           rmw_clients_t* clients, rmw_events_t* events) {
    if (subscriptions != nullptr) {
      arrays_[0] = {subscriptions->subscribers, subscriptions->subscriber_count};
    }
    if (guard_conditions != nullptr) {
      arrays_[1] = {guard_conditions->guard_conditions, guard_conditions->guard_condition_count};
    }
    if (services != nullptr) {
      arrays_[2] = {services->services, services->service_count};
    }
    if (clients != nullptr) {
      arrays_[3] = {clients->clients, clients->client_count};
    }
    if (events != nullptr) {
      arrays_[4] = {events->events, events->event_count};
    }
  }

  // All of them, one array after the other.
  void collect(std::vector<void*>& entities) const {
    entities.clear();
    for (const std::span<void*> array : arrays_) {
      std::copy_if(array.begin(), array.end(), std::back_inserter(entities),
                   [](const void* entity) { return entity != nullptr; });
    }
  }

  // Nulls the entries that are not ready.
  void keep_ready(const std::vector<std::size_t>& ready) const {
    auto next = ready.begin();
    std::size_t position = 0;
    for (const std::span<void*> array : arrays_) {
      for (void*& entity : array) {
        if (entity == nullptr) {
          continue;
        }
        if (next != ready.end() && *next == position) {
          ++next;
        } else {
          entity = nullptr;
        }
        ++position;
      }
    }
  }

 private:
  std::array<std::span<void*>, 5> arrays_;
};

}  // namespace

rmw_guard_condition_t* rmw_create_guard_condition(rmw_context_t* context) {
  RMW_CHECK_HANDLE(context, nullptr);
  auto* handle = new (std::nothrow) rmw_guard_condition_t{kIdentifier, nullptr, context};
  auto* condition = new (std::nothrow) GuardCondition;
  if (handle == nullptr || condition == nullptr) {
    delete handle;
    delete condition;
    RMW_SET_ERROR_MSG("out of memory for a guard condition");
    return nullptr;
  }
  handle->data = static_cast<Waitable*>(condition);
  return handle;
}

rmw_ret_t rmw_destroy_guard_condition(rmw_guard_condition_t* guard_condition) {
  RMW_CHECK_HANDLE(guard_condition, RMW_RET_INVALID_ARGUMENT);
  delete static_cast<Waitable*>(guard_condition->data);
  delete guard_condition;
  return RMW_RET_OK;
}

rmw_ret_t rmw_trigger_guard_condition(const rmw_guard_condition_t* guard_condition) {
  RMW_CHECK_HANDLE(guard_condition, RMW_RET_INVALID_ARGUMENT);
  static_cast<GuardCondition*>(static_cast<Waitable*>(guard_condition->data))->trigger();
  return RMW_RET_OK;
}

rmw_wait_set_t* rmw_create_wait_set(rmw_context_t* context, size_t) {
  RMW_CHECK_HANDLE(context, nullptr);
  auto* wait_set = new (std::nothrow) rmw_wait_set_t{kIdentifier, nullptr, nullptr};
  auto* state = new (std::nothrow) WaitSet;
  if (wait_set == nullptr || state == nullptr) {
    delete wait_set;
    delete state;
    RMW_SET_ERROR_MSG("out of memory for a wait set");
    return nullptr;
  }
  wait_set->data = state;
  return wait_set;
}

rmw_ret_t rmw_destroy_wait_set(rmw_wait_set_t* wait_set) {
  RMW_CHECK_HANDLE(wait_set, RMW_RET_INVALID_ARGUMENT);
  delete static_cast<WaitSet*>(wait_set->data);
  delete wait_set;
  return RMW_RET_OK;
}

rmw_ret_t rmw_wait(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guard_conditions,
                   rmw_services_t* services, rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                   const rmw_time_t* wait_timeout) {
  RMW_CHECK_HANDLE(wait_set, RMW_RET_INVALID_ARGUMENT);
  const Entities arrays(subscriptions, guard_conditions, services, clients, events);
  auto& [waiter, entities, ready] = *static_cast<WaitSet*>(wait_set->data);
  arrays.collect(entities);
  if (!waiter.has_from(0, entities)) {
    waiter.remove_from(0);
    for (void* entity : entities) {
      waiter.add(entity);
    }
  }
  waiter.wait(to_nanoseconds(wait_timeout), ready);
  arrays.keep_ready(ready);
  return ready.empty() ? RMW_RET_TIMEOUT : RMW_RET_OK;
}
