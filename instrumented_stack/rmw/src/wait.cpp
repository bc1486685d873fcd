// Guard conditions, wait sets and rmw_wait().
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "identifier.hpp"
#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "waitable.hpp"

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
  // Room for the entities of a wait.
  std::vector<Waitable*> waitables;
  std::vector<std::size_t> ready;  // indices
};

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
  void collect(std::vector<Waitable*>& waitables) const {
    waitables.clear();
    const auto append = [&](std::span<void*> list) {
      for (void* entity : list) {
        if (entity != nullptr) {
          waitables.push_back(static_cast<Waitable*>(entity));
        }
      }
    };
    std::for_each(level_triggered_.begin(), level_triggered_.end(), append);
    append(guard_conditions_);
  }

  // Whether collect() would give `waitables`.
  bool are(const std::vector<Waitable*>& waitables) const {
    if (waitables.size() != size()) {
      return false;
    }
    auto next = waitables.begin();
    const auto are_next = [&](std::span<void*> list) {
      const auto begin = std::exchange(next, next + std::ssize(list));
      return std::equal(list.begin(), list.end(), begin);
    };
    return std::all_of(level_triggered_.begin(), level_triggered_.end(), are_next) && are_next(guard_conditions_);
  }

  // Nulls what is not among `ready`, indices of `waitables`, collect()'s list, and resets guard conditions. False if
  // nothing is left.
  bool keep(const std::vector<Waitable*>& waitables, const std::vector<std::size_t>& ready) const {
    const bool no_nulls = waitables.size() == size();
    auto next = ready.begin();
    std::size_t index = 0;  // in `waitables`
    const auto keep_in = [&](std::span<void*> list) {
      if (no_nulls) {
        std::fill(list.begin(), list.end(), nullptr);
        for (; next != ready.end() && *next < index + list.size(); ++next) {
          list[*next - index] = waitables[*next];
        }
        index += list.size();
        return;
      }
      for (void*& entity : list) {
        if (entity == nullptr) {
          continue;
        }
        if (next != ready.end() && *next == index) {
          ++next;
        } else {
          entity = nullptr;
        }
        ++index;
      }
    };
    std::for_each(level_triggered_.begin(), level_triggered_.end(), keep_in);
    bool any = next != ready.begin();
    if (next == ready.end()) {
      std::fill(guard_conditions_.begin(), guard_conditions_.end(), nullptr);
      return any;
    }
    keep_in(guard_conditions_);
    for (void*& entity : guard_conditions_) {
      if (entity != nullptr && !static_cast<GuardCondition*>(static_cast<Waitable*>(entity))->consume()) {
        entity = nullptr;
      }
      any |= entity != nullptr;
    }
    return any;
  }

 private:
  std::size_t size() const {
    return std::accumulate(level_triggered_.begin(), level_triggered_.end(), guard_conditions_.size(),
                           [](std::size_t sum, std::span<void*> list) { return sum + list.size(); });
  }

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
  auto& [waiter, waitables, ready] = *static_cast<WaitSet*>(wait_set->data);
  if (!entities.are(waitables)) {
    entities.collect(waitables);
  }
  ready.clear();
  const bool may_block = wait_timeout == nullptr || wait_timeout->sec != 0 || wait_timeout->nsec != 0;
  if (may_block) {
    const auto deadline = deadline_after(wait_timeout);
    waiter.watch(waitables);
    waiter.find_ready(waitables, ready);
    // A wake-up can be for data that another thread has taken meanwhile: then sleep on.
    while (ready.empty() && waiter.wait_until(deadline)) {
      waiter.find_ready(waitables, ready);
    }
  } else if (waiter.watches(waitables)) {
    waiter.find_ready(waitables, ready);
  } else {
    for (std::size_t i = 0; i < waitables.size(); ++i) {
      if (waitables[i]->is_ready()) {
        ready.push_back(i);
      }
    }
  }
  return entities.keep(waitables, ready) ? RMW_RET_OK : RMW_RET_TIMEOUT;
}
