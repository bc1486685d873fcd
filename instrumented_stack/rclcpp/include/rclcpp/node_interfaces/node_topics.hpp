// Puts subscriptions, and the event handlers of publishers and subscriptions, where an executor finds them.
#pragma once

#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp::node_interfaces {

class NodeTopics {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTopics)

  explicit NodeTopics(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Null: the default group. Throw std::runtime_error for a group of another node.
  void add_publisher(const PublisherBase::SharedPtr& publisher, const CallbackGroup::SharedPtr& group);
  void add_subscription(const SubscriptionBase::SharedPtr& subscription, const CallbackGroup::SharedPtr& group);

  const NodeBaseInterface::SharedPtr& get_node_base_interface() const { return node_base_; }

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeTopicsInterface = NodeTopics;

}  // namespace rclcpp::node_interfaces
