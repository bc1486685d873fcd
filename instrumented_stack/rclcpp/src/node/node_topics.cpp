// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_topics.hpp"

#include <stdexcept>

namespace rclcpp::node_interfaces {

PublisherBase::SharedPtr NodeTopics::create_publisher(const std::string& topic_name,
                                                      const PublisherFactory& publisher_factory, const QoS& qos) {
  return publisher_factory.create_typed_publisher(node_base_.get(), topic_name, qos);
}

SubscriptionBase::SharedPtr NodeTopics::create_subscription(const std::string& topic_name,
                                                            const SubscriptionFactory& subscription_factory,
                                                            const QoS& qos) {
  return subscription_factory.create_typed_subscription(node_base_.get(), topic_name, qos);
}

void NodeTopics::add_publisher(PublisherBase::SharedPtr publisher, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create publisher, group not in node.");
  }
  const CallbackGroup::SharedPtr serving = group ? group : node_base_->get_default_callback_group();
  publisher->set_callback_group(serving);
  for (const auto& [type, handler] : publisher->get_event_handlers()) {
    serving->add_waitable(handler);
  }
}

void NodeTopics::add_subscription(SubscriptionBase::SharedPtr subscription, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create subscription, callback group not in node.");
  }
  const CallbackGroup::SharedPtr serving = group ? group : node_base_->get_default_callback_group();
  serving->add_subscription(subscription);
  for (const auto& [type, handler] : subscription->get_event_handlers()) {
    serving->add_waitable(handler);
  }
  if (const Waitable::SharedPtr intra_process = subscription->get_intra_process_waitable()) {
    serving->add_waitable(intra_process);
  }
}

}  // namespace rclcpp::node_interfaces
