// SPDX-License-Identifier: Apache-2.0
// Creates publishers and subscriptions, and adds them and their event handlers to callback groups, where executors find
// them.
#pragma once

#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/publisher_factory.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/subscription_factory.hpp"

namespace rclcpp::node_interfaces {

class NodeTopicsInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTopicsInterface)
  virtual ~NodeTopicsInterface() = default;

  virtual PublisherBase::SharedPtr create_publisher(const std::string& topic_name,
                                                    const PublisherFactory& publisher_factory, const QoS& qos) = 0;
  virtual SubscriptionBase::SharedPtr create_subscription(const std::string& topic_name,
                                                          const SubscriptionFactory& subscription_factory,
                                                          const QoS& qos) = 0;

  // Null means the default group. Throw std::runtime_error if the group belongs to another node.
  virtual void add_publisher(PublisherBase::SharedPtr publisher, CallbackGroup::SharedPtr group) = 0;
  virtual void add_subscription(SubscriptionBase::SharedPtr subscription, CallbackGroup::SharedPtr group) = 0;

  virtual NodeBaseInterface* get_node_base_interface() const = 0;
  virtual NodeTimersInterface* get_node_timers_interface() const = 0;

  // Expands the name and, unless `only_expand`, remaps it.
  virtual std::string resolve_topic_name(const std::string& name, bool only_expand = false) const = 0;
};

}  // namespace rclcpp::node_interfaces
