// How an executor waits for its entities.
#include <rcl/wait_restore.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <utility>

#include "executor_entities.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

namespace {

void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace

void ExecutorEntities::wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready) {
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
    rcl_reset_error();
    append_ready(waitables, ready);
  } catch (...) {
    failure = std::current_exception();
  }

  Owners owners;
  const std::lock_guard lock(mutex_);
  waiting_ = false;
  if (changed_) {
    owners.waited = std::exchange(waited_, {});
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

void ExecutorEntities::append_ready(const std::vector<HeldWaitable>& waitables,
                                    std::vector<detail::ReadyEntity>& ready) const {
  // The entities of one kind, group after group, of which the wait has left the handle. Between these, nothing but the
  // handles is looked at: there may be thousands that have nothing to do.
  const auto append = [&](const auto* const* handles, size_t count, auto WaitedGroup::*kind) {
    const auto* const* const end = handles + count;
    const auto next_left = [end](const auto* const* from) {
      return std::find_if(from, end, [](const void* handle) { return handle != nullptr; });
    };
    auto group = waited_.begin();
    const auto* const* of_group = handles;
    for (const auto* const* left = next_left(handles); left != end; left = next_left(left + 1)) {
      for (; group != waited_.end(); ++group) {
        const auto size = group->in_wait_set ? static_cast<std::ptrdiff_t>(((*group).*kind).size()) : 0;
        if (left - of_group < size) {
          break;
        }
        of_group += size;
      }
      if (group == waited_.end()) {
        return;  // what follows are entities of waitables
      }
      ready.push_back({((*group).*kind)[static_cast<size_t>(left - of_group)].entity, group->group});
    }
  };
  append(wait_set_.timers, wait_set_.size_of_timers, &WaitedGroup::timers);
  append(wait_set_.subscriptions, wait_set_.size_of_subscriptions, &WaitedGroup::subscriptions);
  append(wait_set_.services, wait_set_.size_of_services, &WaitedGroup::services);
  append(wait_set_.clients, wait_set_.size_of_clients, &WaitedGroup::clients);
  append(wait_set_.events, wait_set_.size_of_events, &WaitedGroup::events);
  for (const HeldWaitable& held : waitables) {
    if (held.waitable->is_ready(wait_set_)) {
      ready.push_back({Waitable::WeakPtr(held.waitable), held.group});
    }
  }
}

}  // namespace rclcpp
