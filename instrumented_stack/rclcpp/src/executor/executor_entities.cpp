// SPDX-License-Identifier: Apache-2.0
#include "executor/executor_entities.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace rclcpp {

namespace {

// Compares without owning, not even for a moment.
template <typename T>
bool refers_to(const std::weak_ptr<T>& weak, const std::shared_ptr<T>& shared) {
  return !weak.owner_before(shared) && !shared.owner_before(weak);
}
template <typename T>
bool refer_to_same(const std::weak_ptr<T>& a, const std::weak_ptr<T>& b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

}  // namespace

ExecutorEntities::ExecutorEntities(const Context::SharedPtr& context)
    : interrupt_(context), wait_(context->get_rcl_context(), interrupt_) {}

void ExecutorEntities::add_node(const NodePtr& node) {
  if (node->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error(std::string("Node '") + node->get_fully_qualified_name() +
                             "' has already been added to an executor.");
  }
  node->set_on_change([weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->changed();
    }
  });
  {
    const std::lock_guard lock(mutex_);
    nodes_.push_back(node);
  }
  changed();
}

void ExecutorEntities::remove_node(const NodePtr& node) {
  Owners owners;
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(nodes_.begin(), nodes_.end(), [&node](const auto& weak) { return refers_to(weak, node); });
    if (found == nodes_.end()) {
      throw std::runtime_error("Node needs to be associated with this executor.");
    }
    nodes_.erase(found);
    for (auto served = groups_.begin(); served != groups_.end();) {
      if (served->added_by_hand || !refers_to(served->node, node)) {
        ++served;
        continue;
      }
      if (CallbackGroup::SharedPtr group = served->group.lock()) {
        release(group);
        owners.groups.push_back(std::move(group));
      }
      served = groups_.erase(served);
    }
    ++removals_;
    mark_changed(owners);
  }
  forget(*node);
}

// Without mutex_: a node that is changing at this moment may hold a lock of its own while it calls changed().
void ExecutorEntities::forget(node_interfaces::NodeBaseInterface& node) {
  node.set_on_change(nullptr);
  node.get_associated_with_executor_atomic() = false;
}

void ExecutorEntities::add_group(const CallbackGroup::SharedPtr& group, const NodePtr& node) {
  if (group->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error("Callback group has already been added to an executor.");
  }
  {
    const std::lock_guard lock(mutex_);
    serve(group, node, true);
  }
  changed();
}

void ExecutorEntities::remove_group(const CallbackGroup::SharedPtr& group) {
  Owners owners;
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(groups_.begin(), groups_.end(),
                                  [&group](const ServedGroup& served) { return refers_to(served.group, group); });
  if (found == groups_.end()) {
    throw std::runtime_error("Callback group needs to be associated with this executor.");
  }
  groups_.erase(found);
  release(group);
  ++removals_;
  mark_changed(owners);
}

void ExecutorEntities::remove_all() {
  Owners owners;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& weak : nodes_) {
      if (NodePtr node = weak.lock()) {
        owners.nodes.push_back(std::move(node));
      }
    }
    for (const ServedGroup& served : groups_) {
      if (CallbackGroup::SharedPtr group = served.group.lock()) {
        release(group);
        owners.groups.push_back(std::move(group));
      }
    }
    nodes_.clear();
    groups_.clear();
    mark_changed(owners);
  }
  for (const NodePtr& node : owners.nodes) {
    forget(*node);
  }
}

std::vector<CallbackGroup::WeakPtr> ExecutorEntities::groups(Origin origin) {
  Owners owners;
  const std::lock_guard lock(mutex_);
  find_groups(owners);  // a new node's groups count from its adding, not from the next wait
  std::vector<CallbackGroup::WeakPtr> groups;
  for (const ServedGroup& served : groups_) {
    if (origin == Origin::kAny || served.added_by_hand == (origin == Origin::kAddedByHand)) {
      groups.push_back(served.group);
    }
  }
  return groups;
}

std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> ExecutorEntities::entities() {
  Owners owners;
  const std::lock_guard lock(mutex_);
  find_groups(owners);
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> result;
  for (const ServedGroup& served : groups_) {
    if (CallbackGroup::SharedPtr group = served.group.lock()) {
      group->collect(result.emplace_back(served.group, CallbackGroup::Entities{}).second);
      group->take_left_ready();  // an executor that does not wait is told of each trigger
      owners.groups.push_back(std::move(group));
    }
  }
  return result;
}

void ExecutorEntities::erase_unserved(std::vector<detail::ReadyEntity>& ready) {
  std::vector<detail::ReadyEntity> unserved;
  {
    const std::lock_guard lock(mutex_);
    const auto first_unserved =
        std::stable_partition(ready.begin(), ready.end(), [this](const detail::ReadyEntity& entity) {
          return std::any_of(groups_.begin(), groups_.end(),
                             [&](const ServedGroup& served) { return refer_to_same(served.group, entity.group); });
        });
    unserved.assign(std::make_move_iterator(first_unserved), std::make_move_iterator(ready.end()));
    ready.erase(first_unserved, ready.end());
  }
  // Without the lock: this wakes another executor.
  for (const detail::ReadyEntity& entity : unserved) {
    const auto* waitable = std::get_if<Waitable::WeakPtr>(&entity.entity);
    if (const CallbackGroup::SharedPtr group = waitable ? entity.group.lock() : nullptr) {
      group->leave_ready(*waitable);
    }
  }
}

[[gnu::hot]] void ExecutorEntities::wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready,
                                         std::vector<detail::ReadyEntity>& ready_earlier) {
  {
    std::optional<Owners> owners;
    const std::lock_guard lock(mutex_);
    if (changed_) {
      const std::size_t before = ready_earlier.size();
      rebuild(owners.emplace(), ready_earlier);
      if (ready_earlier.size() > before) {
        timeout = std::chrono::nanoseconds::zero();
      }
    }
    waiting_ = true;
  }

  std::exception_ptr failure;
  try {
    wait_.wait(timeout, ready);
  } catch (...) {
    failure = std::current_exception();
  }

  {
    std::unique_lock lock(mutex_);
    waiting_ = false;
    if (changed_) {
      const WaitedEntities outdated = wait_.exchange({});
      lock.unlock();
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

void ExecutorEntities::interrupt() {
  interrupt_.trigger();
  const std::lock_guard lock(mutex_);
  if (on_change_) {
    on_change_();
  }
}

void ExecutorEntities::set_on_change(std::function<void()> on_change) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(on_change);
}

void ExecutorEntities::changed() {
  Owners owners;
  const std::lock_guard lock(mutex_);
  mark_changed(owners);
}

void ExecutorEntities::mark_changed(Owners& owners) {
  changed_ = true;
  if (waiting_) {
    interrupt_.trigger();
  } else {
    owners.waited = wait_.exchange({});
  }
  if (on_change_) {
    on_change_();
  }
}

void ExecutorEntities::find_groups(Owners& owners) {
  const auto expired = [](const auto& weak) { return weak.expired(); };
  nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(), expired), nodes_.end());
  for (const auto& weak : nodes_) {
    if (NodePtr node = weak.lock()) {
      node->for_each_callback_group([&](CallbackGroup::SharedPtr group) {
        if (group->automatically_add_to_executor_with_node() &&
            !group->get_associated_with_executor_atomic().exchange(true)) {
          serve(group, node, false);
        }
        owners.groups.push_back(std::move(group));
      });
      owners.nodes.push_back(std::move(node));
    }
  }
  // A group may outlive its node, with a client for example. It is served on.
  groups_.erase(
      std::remove_if(groups_.begin(), groups_.end(), [](const ServedGroup& served) { return served.group.expired(); }),
      groups_.end());
}

void ExecutorEntities::rebuild(Owners& owners, std::vector<detail::ReadyEntity>& ready_earlier) {
  find_groups(owners);
  std::vector<WaitedEntities::Group> groups;
  for (const ServedGroup& served : groups_) {
    if (CallbackGroup::SharedPtr group = served.group.lock()) {
      groups.push_back({served.group, group->shared_can_be_taken_from()});
      group->collect(owners.entities.emplace_back());
      for (Waitable::WeakPtr& waitable : group->take_left_ready()) {
        ready_earlier.push_back({std::move(waitable), served.group});
      }
      owners.groups.push_back(std::move(group));
    }
  }
  owners.waited = wait_.exchange(WaitedEntities(std::move(groups), owners.entities));
  changed_ = false;
}

void ExecutorEntities::serve(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool added_by_hand) {
  group->set_on_change([weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->changed();
    }
  });
  groups_.push_back({group, node, added_by_hand});
}

void ExecutorEntities::release(const CallbackGroup::SharedPtr& group) {
  group->set_on_change(nullptr);
  group->get_associated_with_executor_atomic() = false;
}

}  // namespace rclcpp
