// SPDX-License-Identifier: Apache-2.0
// Guard conditions, wait sets and rmw_wait().
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rmw/wait_again.h"
#include "types/identifier.hpp"
#include "wait/waitable.hpp"

using rmw_fastrtps::GuardCondition;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::Waitable;
using rmw_fastrtps::Waiter;

namespace {

// The longest wait that a deadline is computed for; longer ones have none.
constexpr uint64_t kForeverSeconds = 1000000000;  // about 31 years

std::optional<Waiter::TimePoint> deadline_after(const rmw_time_t* timeout) {
  if (timeout == nullptr || timeout->sec >= kForeverSeconds) {
    return std::nullopt;
  }
  return std::chrono::steady_clock::now() + std::chrono::seconds(timeout->sec) +
         std::chrono::nanoseconds(timeout->nsec);
}

// The state behind rmw_wait_set_t.
struct WaitSet {
  Waiter waiter;
  // The entities of the last wait, without null entries.
  std::vector<Waitable*> waitables;
  std::vector<std::size_t> ready;  // indices
  std::size_t first_guard_condition = 0;
};

enum class Occasion { kFirst, kAgain };

// Finds what is ready of `waitables`, waiting for it if need be. Who only looks, once, need not be told by those that
// become ready; who looks again and again is spared asking all of them each time.
[[gnu::hot]] void find_ready(WaitSet& wait_set, const rmw_time_t* timeout, Occasion occasion) {
  auto& [waiter, waitables, ready, first_guard_condition] = wait_set;
  ready.clear();
  const bool may_block = timeout == nullptr || timeout->sec != 0 || timeout->nsec != 0;
  if (!may_block && occasion == Occasion::kFirst && !waiter.watches(waitables)) {
    for (std::size_t i = 0; i < waitables.size(); ++i) {
      if (waitables[i]->is_ready()) {
        ready.push_back(i);
      }
    }
    return;
  }
  const auto deadline = deadline_after(timeout);
  waiter.watch(waitables);
  waiter.find_ready(waitables, ready);
  // A wake-up can be for data that another thread has taken meanwhile: then sleep on.
  while (may_block && ready.empty() && waiter.wait_ready(deadline, waitables, ready)) {
  }
}

// Resets guard conditions, which are ready once per trigger; leaves out those that another thread has reset.
void consume_guard_conditions(WaitSet& wait_set) {
  if (wait_set.ready.empty() || wait_set.ready.back() < wait_set.first_guard_condition) {
    return;
  }
  std::erase_if(wait_set.ready, [&](std::size_t i) {
    return i >= wait_set.first_guard_condition && !static_cast<GuardCondition*>(wait_set.waitables[i])->consume();
  });
}

// The entities of one call of rmw_wait(), null entries left out by each function.
class Entities {
 public:
  Entities(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guard_conditions, rmw_services_t* services,
           rmw_clients_t* clients, rmw_events_t* events) {
    if (subscriptions != nullptr) {
      level_triggered_[0] = {subscriptions->subscribers, subscriptions->subscriber_count};
    }
    if (services != nullptr) {
      level_triggered_[1] = {services->services, services->service_count};
    }
    if (clients != nullptr) {
      level_triggered_[2] = {clients->clients, clients->client_count};
    }
    if (events != nullptr) {
      level_triggered_[3] = {events->events, events->event_count};
    }
    if (guard_conditions != nullptr) {
      guard_conditions_ = {guard_conditions->guard_conditions, guard_conditions->guard_condition_count};
    }
  }

  // The entities that are there, one list after the other.
  void collect(WaitSet& wait_set) const {
    wait_set.waitables.clear();
    const auto append = [&](std::span<void*> list) {
      for (void* entity : list) {
        if (entity != nullptr) {
          wait_set.waitables.push_back(static_cast<Waitable*>(entity));
        }
      }
    };
    std::for_each(level_triggered_.begin(), level_triggered_.end(), append);
    wait_set.first_guard_condition = wait_set.waitables.size();
    append(guard_conditions_);
  }

  // Nulls what is not among the ready ones.
  void keep_ready(const WaitSet& wait_set) const {
    auto next = wait_set.ready.begin();
    std::size_t index = 0;
    const auto keep_in = [&](std::span<void*> list) {
      for (void*& entity : list) {
        if (entity == nullptr) {
          continue;
        }
        if (next != wait_set.ready.end() && *next == index) {
          ++next;
        } else {
          entity = nullptr;
        }
        ++index;
      }
    };
    std::for_each(level_triggered_.begin(), level_triggered_.end(), keep_in);
    keep_in(guard_conditions_);
  }

 private:
  std::array<std::span<void*>, 4> level_triggered_;  // of subscriptions, services, clients and events
  std::span<void*> guard_conditions_;
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
  const Entities entities(subscriptions, guard_conditions, services, clients, events);
  WaitSet& state = *static_cast<WaitSet*>(wait_set->data);
  entities.collect(state);
  find_ready(state, wait_timeout, Occasion::kFirst);
  consume_guard_conditions(state);
  entities.keep_ready(state);
  return state.ready.empty() ? RMW_RET_TIMEOUT : RMW_RET_OK;
}

[[gnu::hot]] rmw_ret_t rmw_wait_again(rmw_wait_set_t* wait_set, const rmw_time_t* wait_timeout, const size_t** ready,
                                      size_t* ready_count) {
  RMW_CHECK_HANDLE(wait_set, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ready, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ready_count, RMW_RET_INVALID_ARGUMENT);
  WaitSet& state = *static_cast<WaitSet*>(wait_set->data);
  find_ready(state, wait_timeout, Occasion::kAgain);
  consume_guard_conditions(state);
  *ready = state.ready.data();
  *ready_count = state.ready.size();
  return state.ready.empty() ? RMW_RET_TIMEOUT : RMW_RET_OK;
}
