// SPDX-License-Identifier: Apache-2.0
// How an executor waits for its entities.
#include <rcl/wait_restore.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <utility>

#include "base/require_ok.hpp"
#include "executor/executor_entities.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

using detail::require_ok;

[[gnu::hot]] void ExecutorEntities::wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready) {
  {
    Owners owners;
    const std::lock_guard lock(mutex_);
    if (changed_) {
      rebuild(owners);
    }
    waiting_ = true;
  }

  std::exception_ptr failure;
  std::vector<HeldWaitable> waitables;
  try {
    fill_wait_set(waitables);
    const rcl_ret_t ret = rcl_wait(&wait_set_, timeout.count());
    if (ret != RCL_RET_OK && ret != RCL_RET_TIMEOUT) {
      exceptions::throw_from_rcl_error(ret, "rcl_wait() failed");
    }
    append_ready(waitables, ready);
  } catch (...) {
    failure = std::current_exception();
  }

  {
    std::unique_lock lock(mutex_);
    waiting_ = false;
    if (changed_) {
      const std::vector<WaitedGroup> outdated = std::exchange(waited_, {});
      lock.unlock();
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

void ExecutorEntities::fill_wait_set(std::vector<HeldWaitable>& waitables) {
  Sizes sizes;
  sizes.guard_conditions = 1;
  bool same_groups = true;
  for (WaitedGroup& group : waited_) {
    const bool in_wait_set = *group.can_be_taken_from;
    same_groups = same_groups && in_wait_set == group.in_wait_set;
    group.in_wait_set = in_wait_set;
    if (!in_wait_set) {
      continue;
    }
    sizes.timers += group.timers.size();
    sizes.subscriptions += group.subscriptions.size();
    sizes.services += group.services.size();
    sizes.clients += group.clients.size();
    sizes.events += group.events.size();
    for (const Waitable::WeakPtr& weak : group.waitables) {
      if (Waitable::SharedPtr waitable = weak.lock()) {
        sizes.timers += waitable->get_number_of_ready_timers();
        sizes.subscriptions += waitable->get_number_of_ready_subscriptions();
        sizes.services += waitable->get_number_of_ready_services();
        sizes.clients += waitable->get_number_of_ready_clients();
        sizes.events += waitable->get_number_of_ready_events();
        sizes.guard_conditions += waitable->get_number_of_ready_guard_conditions();
        waitables.push_back({std::move(waitable), group.group});
      }
    }
  }
  if (same_groups && sizes == kept_sizes_) {
    require_ok(rcl_wait_set_restore(&wait_set_), "couldn't restore wait set");
  } else {
    kept_sizes_ = {};
    add_handles(sizes);
    kept_sizes_ = sizes;
  }
  // Last, so that the indices of the others are known without asking.
  for (const HeldWaitable& held : waitables) {
    held.waitable->add_to_wait_set(wait_set_);
  }
}

void ExecutorEntities::add_handles(const Sizes& sizes) {
  require_ok(rcl_wait_set_resize(&wait_set_, sizes.subscriptions, sizes.guard_conditions, sizes.timers, sizes.clients,
                                 sizes.services, sizes.events),
             "couldn't resize the wait set");
  require_ok(rcl_wait_set_add_guard_condition(&wait_set_, &interrupt_.get_rcl_guard_condition(), nullptr),
             "couldn't add guard condition to wait set");
  for (const WaitedGroup& group : waited_) {
    if (!group.in_wait_set) {
      continue;
    }
    for (const auto& timer : group.timers) {
      require_ok(rcl_wait_set_add_timer(&wait_set_, timer.handle.get(), nullptr), "couldn't add timer to wait set");
    }
    for (const auto& subscription : group.subscriptions) {
      require_ok(rcl_wait_set_add_subscription(&wait_set_, subscription.handle.get(), nullptr),
                 "couldn't add subscription to wait set");
    }
    for (const auto& service : group.services) {
      require_ok(rcl_wait_set_add_service(&wait_set_, service.handle.get(), nullptr),
                 "couldn't add service to wait set");
    }
    for (const auto& client : group.clients) {
      require_ok(rcl_wait_set_add_client(&wait_set_, client.handle.get(), nullptr), "couldn't add client to wait set");
    }
    for (const auto& event : group.events) {
      require_ok(rcl_wait_set_add_event(&wait_set_, event.handle.get(), nullptr), "couldn't add event to wait set");
    }
  }
  require_ok(rcl_wait_set_keep(&wait_set_), "couldn't keep wait set");
}

template <typename KindT>
[[gnu::hot, gnu::noinline]] void ExecutorEntities::append_left(const rcl_wait_set_left_indices_t& left,
                                                               KindT WaitedGroup::*kind,
                                                               std::vector<detail::ReadyEntity>& ready) const {
  auto group = waited_.begin();
  size_t first = 0;  // of the group
  for (size_t i = 0; i < left.count; ++i) {
    const auto size = [&] { return group->in_wait_set ? ((*group).*kind).size() : 0; };
    for (size_t in_group = size(); left.indices[i] - first >= in_group; in_group = size()) {
      first += in_group;
      ++group;
    }
    ready.push_back({((*group).*kind)[left.indices[i] - first].entity, group->group});
  }
}

[[gnu::hot]] void ExecutorEntities::append_ready(const std::vector<HeldWaitable>& waitables,
                                                 std::vector<detail::ReadyEntity>& ready) const {
  // Nothing but what the wait has left is looked at: there may be thousands that have nothing to do.
  const rcl_wait_set_left_t& left = *rcl_wait_set_get_left(&wait_set_);
  if (left.timers.count != 0) {
    append_left(left.timers, &WaitedGroup::timers, ready);
  }
  if (left.subscriptions.count != 0) {
    append_left(left.subscriptions, &WaitedGroup::subscriptions, ready);
  }
  if (left.services.count != 0) {
    append_left(left.services, &WaitedGroup::services, ready);
  }
  if (left.clients.count != 0) {
    append_left(left.clients, &WaitedGroup::clients, ready);
  }
  if (left.events.count != 0) {
    append_left(left.events, &WaitedGroup::events, ready);
  }
  for (const HeldWaitable& held : waitables) {
    if (held.waitable->is_ready(wait_set_)) {
      ready.push_back({Waitable::WeakPtr(held.waitable), held.group});
    }
  }
}

}  // namespace rclcpp
