// SPDX-License-Identifier: Apache-2.0
#include "executor/asked_waitables.hpp"

#include <algorithm>
#include <exception>
#include <rcl/rmw_entity.hpp>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

bool is_due(const rcl_timer_t* timer) {
  bool is_ready = false;
  require_ok(rcl_timer_is_ready(timer, &is_ready), "couldn't ask a timer of a waitable");
  return is_ready;
}

}  // namespace

AskedWaitables::AskedWaitables(const std::shared_ptr<rcl_context_t>& context)
    : context_(context), wait_set_(rcl_get_zero_initialized_wait_set()) {
  require_ok(rcl_wait_set_init(&wait_set_, 0, 0, 0, 0, 0, 0, context_.get(), rcl_get_default_allocator()),
             "failed to create wait set");
}

AskedWaitables::~AskedWaitables() {
  detail::log_error(rcl_wait_set_fini(&wait_set_), "failed to destroy wait set");
}

[[gnu::hot]] void AskedWaitables::ask(const WaitedEntities& waited, rmw_fastrtps::Waiter& waiter, std::size_t first) {
  if (waited.waitables.empty()) {
    return;
  }
  first_ = first;
  hold(waited);
  if (find_positions(waiter)) {
    return;
  }
  waiter.remove_from(first);
  registrations_ = wanted_;
  positions_.clear();
  for (const auto& [rmw_entity, waitable] : registrations_) {
    positions_.push_back(first + positions_.size());
    waiter.add(rmw_entity, &is_held_[waitable]);
  }
}

void AskedWaitables::hold(const WaitedEntities& waited) {
  if (is_held_.size() != waited.waitables.size()) {
    is_held_ = std::vector<std::atomic_bool>(waited.waitables.size());
  }
  Sizes sizes;
  for (std::size_t index = 0; index < waited.waitables.size(); ++index) {
    const auto& [weak, group] = waited.waitables[index];
    Waitable::SharedPtr waitable = *waited.groups[group].may_be_taken ? weak.lock() : nullptr;
    is_held_[index] = waitable != nullptr;
    if (!waitable) {
      continue;
    }
    sizes.timers += waitable->get_number_of_ready_timers();
    sizes.subscriptions += waitable->get_number_of_ready_subscriptions();
    sizes.services += waitable->get_number_of_ready_services();
    sizes.clients += waitable->get_number_of_ready_clients();
    sizes.events += waitable->get_number_of_ready_events();
    sizes.guard_conditions += waitable->get_number_of_ready_guard_conditions();
    held_.push_back({std::move(waitable), index});
  }
  fill_wait_set(sizes);
}

void AskedWaitables::fill_wait_set(const Sizes& sizes) {
  if (sizes == sizes_) {
    require_ok(rcl_wait_set_clear(&wait_set_), "couldn't clear the wait set");
  } else {
    require_ok(rcl_wait_set_resize(&wait_set_, sizes.subscriptions, sizes.guard_conditions, sizes.timers, sizes.clients,
                                   sizes.services, sizes.events),
               "couldn't resize the wait set");
    sizes_ = sizes;
  }
  entries_.clear();
  wanted_.clear();
  Sizes next;
  for (const auto& [waitable, index] : held_) {
    waitable->add_to_wait_set(wait_set_);
    list_entries(index, next);
  }
}

void AskedWaitables::list_entries(std::size_t waitable, Sizes& next) {
  const auto list = [&](auto** entries, std::size_t count, std::size_t& at) {
    for (; at < count && entries[at] != nullptr; ++at) {
      entries_.emplace_back(&entries[at]);
      wanted_.push_back({rcl::rmw_entity_of(entries[at]), waitable});
    }
  };
  list(wait_set_.subscriptions, wait_set_.size_of_subscriptions, next.subscriptions);
  list(wait_set_.services, wait_set_.size_of_services, next.services);
  list(wait_set_.clients, wait_set_.size_of_clients, next.clients);
  list(wait_set_.events, wait_set_.size_of_events, next.events);
  list(wait_set_.guard_conditions, wait_set_.size_of_guard_conditions, next.guard_conditions);
  list(wait_set_.timers, wait_set_.size_of_timers, next.timers);
}

bool AskedWaitables::find_positions(const rmw_fastrtps::Waiter& waiter) {
  if (!waiter.has_only_living()) {
    return false;
  }
  positions_.clear();
  for (std::size_t i = 0; i < registrations_.size(); ++i) {
    if (!is_held_[registrations_[i].waitable]) {
      continue;
    }
    if (positions_.size() == wanted_.size() || registrations_[i] != wanted_[positions_.size()]) {
      return false;
    }
    positions_.push_back(first_ + i);
  }
  return positions_.size() == wanted_.size();
}

std::int64_t AskedWaitables::time_until_first_timer() const {
  std::int64_t time = TimerQueue::kNever;
  if (held_.empty()) {
    return time;
  }
  for (std::size_t i = 0; i < wait_set_.size_of_timers; ++i) {
    if (wait_set_.timers[i] == nullptr) {
      continue;
    }
    std::int64_t until_next = 0;
    const rcl_ret_t ret = rcl_timer_get_time_until_next_call(wait_set_.timers[i], &until_next);
    if (ret != RCL_RET_TIMER_CANCELED) {
      require_ok(ret, "couldn't get the time of a timer of a waitable");
      time = std::min(time, until_next);
    }
  }
  return time;
}

void AskedWaitables::append_ready(const WaitedEntities& waited, const std::size_t* begin, const std::size_t* end,
                                  std::vector<detail::ReadyEntity>& ready) {
  if (held_.empty()) {
    return;
  }
  // Waitables find the entries null of what is not ready.
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    std::visit(
        [&]<typename EntityT>(const EntityT** entry) {
          bool is_ready = false;
          if constexpr (std::is_same_v<EntityT, rcl_timer_t>) {
            is_ready = is_due(*entry);
          } else {
            is_ready = std::binary_search(begin, end, positions_[i]);
          }
          if (!is_ready) {
            *entry = nullptr;
          }
        },
        entries_[i]);
  }
  std::exception_ptr failure;
  for (const auto& [waitable, index] : held_) {
    try {
      if (waitable->is_ready(wait_set_)) {
        ready.push_back({Waitable::WeakPtr(waitable), waited.groups[waited.waitables[index].group].group});
      }
    } catch (...) {
      failure = failure ? failure : std::current_exception();
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace rclcpp
