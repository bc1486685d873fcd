// SPDX-License-Identifier: Apache-2.0
// Creates publishers and subscriptions of a node and adds them to its callback groups.
#pragma once

#include <string>
#include <utility>

#include "rclcpp/node_interfaces/node_topics_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeTopics : public NodeTopicsInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTopics)

  NodeTopics(NodeBaseInterface::SharedPtr node_base, NodeTimersInterface::SharedPtr node_timers)
      : node_base_(std::move(node_base)), node_timers_(std::move(node_timers)) {}

  PublisherBase::SharedPtr create_publisher(const std::string& topic_name, const PublisherFactory& publisher_factory,
                                            const QoS& qos) override;
  SubscriptionBase::SharedPtr create_subscription(const std::string& topic_name,
                                                  const SubscriptionFactory& subscription_factory,
                                                  const QoS& qos) override;
  void add_publisher(PublisherBase::SharedPtr publisher, CallbackGroup::SharedPtr group) override;
  void add_subscription(SubscriptionBase::SharedPtr subscription, CallbackGroup::SharedPtr group) override;

  NodeBaseInterface* get_node_base_interface() const override { return node_base_.get(); }
  NodeTimersInterface* get_node_timers_interface() const override { return node_timers_.get(); }

  std::string resolve_topic_name(const std::string& name, bool only_expand = false) const override {
    return node_base_->resolve_topic_or_service_name(name, false, only_expand);
  }

 private:
  NodeBaseInterface::SharedPtr node_base_;
  NodeTimersInterface::SharedPtr node_timers_;
};

}  // namespace rclcpp::node_interfaces
