// SPDX-License-Identifier: Apache-2.0
// How a program's own executor keeps the entities that it waits for. The executors of rclcpp do not use it.
#pragma once

#include <rcl/allocator.h>
#include <rcl/wait.h>

#include <cstddef>
#include <map>
#include <memory>

#include "rclcpp/any_executable.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::memory_strategy {

// In each round, an executor calls clear_handles(), collect_entities(), add_handles_to_wait_set(), waits, and calls
// remove_null_handles(). Then get_next_…() gives out what is ready. Not thread safe.
class MemoryStrategy {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(MemoryStrategy)
  using WeakCallbackGroupsToNodesMap = std::map<CallbackGroup::WeakPtr, node_interfaces::NodeBaseInterface::WeakPtr,
                                                std::owner_less<CallbackGroup::WeakPtr>>;

  MemoryStrategy() = default;
  virtual ~MemoryStrategy() = default;
  RCLCPP_DISABLE_COPY(MemoryStrategy)

  // Takes the entities of groups that may be executed. Returns whether a group or a node does not exist any more.
  virtual bool collect_entities(const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;

  // How many entities there are, those of waitables included.
  virtual size_t number_of_ready_subscriptions() const = 0;
  virtual size_t number_of_ready_services() const = 0;
  virtual size_t number_of_ready_clients() const = 0;
  virtual size_t number_of_ready_events() const = 0;
  virtual size_t number_of_ready_timers() const = 0;
  virtual size_t number_of_guard_conditions() const = 0;
  virtual size_t number_of_waitables() const = 0;

  // Throws std::runtime_error for null.
  virtual void add_waitable_handle(const Waitable::SharedPtr& waitable) = 0;
  // Returns false, and logs why, if the wait set does not take one.
  virtual bool add_handles_to_wait_set(rcl_wait_set_t* wait_set) = 0;
  virtual void clear_handles() = 0;
  // Forgets what is not ready.
  virtual void remove_null_handles(rcl_wait_set_t* wait_set) = 0;

  // The strategy holds a plain pointer.
  virtual void add_guard_condition(const GuardCondition& guard_condition) = 0;
  virtual void remove_guard_condition(const GuardCondition* guard_condition) = 0;

  // Set `any_exec` to an entity whose group may be taken from, and forget this entity. They leave `any_exec` as it is
  // if there is none. A timer is called, as TimerBase::call().
  virtual void get_next_subscription(AnyExecutable& any_exec,
                                     const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;
  virtual void get_next_service(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;
  virtual void get_next_client(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;
  virtual void get_next_timer(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;
  virtual void get_next_waitable(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) = 0;

  virtual rcl_allocator_t get_allocator() = 0;

  // The living entity with a handle, the group of an entity, and the node of a group; null if there is none.
  static SubscriptionBase::SharedPtr get_subscription_by_handle(
      const std::shared_ptr<const rcl_subscription_t>& subscriber_handle,
      const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static ServiceBase::SharedPtr get_service_by_handle(const std::shared_ptr<const rcl_service_t>& service_handle,
                                                      const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static ClientBase::SharedPtr get_client_by_handle(const std::shared_ptr<const rcl_client_t>& client_handle,
                                                    const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static TimerBase::SharedPtr get_timer_by_handle(const std::shared_ptr<const rcl_timer_t>& timer_handle,
                                                  const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static node_interfaces::NodeBaseInterface::SharedPtr get_node_by_group(
      const CallbackGroup::SharedPtr& group, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static CallbackGroup::SharedPtr get_group_by_subscription(const SubscriptionBase::SharedPtr& subscription,
                                                            const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static CallbackGroup::SharedPtr get_group_by_service(const ServiceBase::SharedPtr& service,
                                                       const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static CallbackGroup::SharedPtr get_group_by_client(const ClientBase::SharedPtr& client,
                                                      const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static CallbackGroup::SharedPtr get_group_by_timer(const TimerBase::SharedPtr& timer,
                                                     const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
  static CallbackGroup::SharedPtr get_group_by_waitable(const Waitable::SharedPtr& waitable,
                                                        const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes);
};

}  // namespace rclcpp::memory_strategy
