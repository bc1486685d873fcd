// SPDX-License-Identifier: Apache-2.0
// What an executor waits for until the next change: the rcl handles of entities, so that a wait never looks at a dead
// entity, and the rclcpp objects weakly, so that a user's reset() destroys a subscription at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

struct WaitedEntities {
  struct Group {
    CallbackGroup::WeakPtr group;
    std::shared_ptr<const std::atomic_bool> may_be_taken;  // false while nothing of the group may be executed
  };
  // A timer, subscription, service, client or event handler. There can be thousands.
  struct Entity {
    decltype(detail::ReadyEntity::entity) entity;
    std::shared_ptr<const void> handle;
    void* rmw_entity;  // lives as long as the handle
    std::size_t group;
  };
  // A waitable that is asked for its entities before each wait. Event handlers are not: theirs never change.
  struct AskedWaitable {
    Waitable::WeakPtr waitable;
    std::size_t group;
  };

  WaitedEntities() = default;
  // With the living entities of each group.
  WaitedEntities(std::vector<Group> groups, const std::vector<CallbackGroup::Entities>& living);

  detail::ReadyEntity if_ready(const Entity& entity) const { return {entity.entity, groups[entity.group].group}; }

  std::vector<Group> groups;
  std::vector<Entity> timers;
  std::vector<Entity> entities;  // kind after kind, in the order in which they are executed
  std::vector<AskedWaitable> waitables;
};

}  // namespace rclcpp
