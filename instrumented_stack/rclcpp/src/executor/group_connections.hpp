// SPDX-License-Identifier: Apache-2.0
// Connects the entities of an executor with its queues: the middleware then tells the queues what has arrived.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "executor/group_queues.hpp"
#include "rclcpp/callback_group.hpp"

namespace rclcpp {

class ExecutorEntities;

// Thread safe.
class GroupConnections {
 public:
  GroupConnections(ExecutorEntities& entities, std::shared_ptr<GroupQueues> queues)
      : entities_(entities), queues_(std::move(queues)) {}
  RCLCPP_DISABLE_COPY(GroupConnections)

  // Connects what is new, and disconnects what has gone. If a waitable cannot be connected, the others are, and its
  // exception is thrown.
  void update();
  // Disconnects the groups that the executor does not serve any more.
  void disconnect_unserved();

 private:
  using Entity = GroupQueues::Entity;
  using Group = GroupQueues::Group;
  using Gone = std::vector<std::shared_ptr<Entity>>;
  // An address, and the kind of the entity: a waitable may begin with one of another kind.
  using Key = std::pair<const void*, std::size_t>;

  // These with the mutex held.
  void connect_group(const std::shared_ptr<Group>& group, const CallbackGroup::Entities& entities, Gone& gone,
                     std::exception_ptr& failure);
  template <typename EntityT>
  void connect(const std::shared_ptr<Group>& group, const std::shared_ptr<EntityT>& entity, Gone& gone);
  // Erases what `is_gone`, and disconnects it.
  template <typename PredicateT>
  void erase(PredicateT is_gone, Gone& gone);
  void forget(Gone& gone);

  ExecutorEntities& entities_;
  const std::shared_ptr<GroupQueues> queues_;
  std::mutex mutex_;
  std::map<CallbackGroup::WeakPtr, std::shared_ptr<Group>, std::owner_less<CallbackGroup::WeakPtr>> groups_;
  struct Connected {
    std::shared_ptr<Entity> entity;
    std::uint64_t seen;  // the last update that found it
  };
  std::map<Key, Connected> connected_;
  std::uint64_t updates_ = 0;
  bool have_timers_changed_ = false;
};

}  // namespace rclcpp
