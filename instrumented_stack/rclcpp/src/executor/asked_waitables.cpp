// SPDX-License-Identifier: Apache-2.0
#include "executor/asked_waitables.hpp"

#include <algorithm>
#include <rcl/rmw_entity.hpp>
#include <type_traits>
#include <utility>

#include "base/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

// Calls `visit` with a reference to each entry that is not null, always in the same order.
template <typename VisitT>
void for_each_entry(const rcl_wait_set_t& wait_set, VisitT visit) {
  const auto visit_kind = [&visit](auto** entries, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (entries[i] != nullptr) {
        visit(entries[i]);
      }
    }
  };
  visit_kind(wait_set.subscriptions, wait_set.size_of_subscriptions);
  visit_kind(wait_set.services, wait_set.size_of_services);
  visit_kind(wait_set.clients, wait_set.size_of_clients);
  visit_kind(wait_set.events, wait_set.size_of_events);
  visit_kind(wait_set.guard_conditions, wait_set.size_of_guard_conditions);
  visit_kind(wait_set.timers, wait_set.size_of_timers);
}

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
  if (rcl_wait_set_fini(&wait_set_) != RCL_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "failed to destroy wait set: %s", rcl_get_error_string().str);
    rcl_reset_error();
  }
}

[[gnu::hot]] void AskedWaitables::ask(const WaitedEntities& waited, rmw_fastrtps::Waiter& waiter, std::size_t first) {
  first_ = first;
  rmw_entities_.clear();
  if (!waited.waitables.empty()) {
    Sizes sizes;
    for (const auto& [weak, group] : waited.waitables) {
      Waitable::SharedPtr waitable = *waited.groups[group].may_be_taken ? weak.lock() : nullptr;
      if (!waitable) {
        continue;
      }
      sizes.timers += waitable->get_number_of_ready_timers();
      sizes.subscriptions += waitable->get_number_of_ready_subscriptions();
      sizes.services += waitable->get_number_of_ready_services();
      sizes.clients += waitable->get_number_of_ready_clients();
      sizes.events += waitable->get_number_of_ready_events();
      sizes.guard_conditions += waitable->get_number_of_ready_guard_conditions();
      held_.push_back({std::move(waitable), group});
    }
    fill_wait_set(sizes);
    for_each_entry(wait_set_, [this](const auto* entry) { rmw_entities_.push_back(rcl::rmw_entity_of(entry)); });
  }
  if (!waiter.has_from(first, rmw_entities_)) {
    waiter.remove_from(first);
    for (void* entity : rmw_entities_) {
      waiter.add(entity);
    }
  }
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
  for (const Held& held : held_) {
    held.waitable->add_to_wait_set(wait_set_);
  }
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

void AskedWaitables::append_ready(const WaitedEntities& waited, const std::size_t* next, const std::size_t* end,
                                  std::vector<detail::ReadyEntity>& ready) {
  if (held_.empty()) {
    return;
  }
  // Waitables find the entries null of what is not ready.
  std::size_t position = first_;
  for_each_entry(wait_set_, [&]<typename EntityT>(const EntityT*& entry) {
    bool is_ready = next != end && *next == position;
    next += is_ready ? 1 : 0;
    ++position;
    if constexpr (std::is_same_v<EntityT, rcl_timer_t>) {
      is_ready = is_due(entry);
    }
    if (!is_ready) {
      entry = nullptr;
    }
  });
  for (const Held& held : held_) {
    if (held.waitable->is_ready(wait_set_)) {
      ready.push_back({Waitable::WeakPtr(held.waitable), waited.groups[held.group].group});
    }
  }
}

}  // namespace rclcpp
