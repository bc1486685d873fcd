// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_topics.hpp"

#include <stdexcept>

namespace rclcpp::node_interfaces {

void NodeTopics::add_publisher(const PublisherBase::SharedPtr& publisher, const CallbackGroup::SharedPtr& group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create publisher, group not in node.");
  }
  const CallbackGroup::SharedPtr serving = group ? group : node_base_->get_default_callback_group();
  publisher->set_callback_group(serving);
  for (const auto& [type, handler] : publisher->get_event_handlers()) {
    serving->add_waitable(handler);
  }
}

void NodeTopics::add_subscription(const SubscriptionBase::SharedPtr& subscription,
                                  const CallbackGroup::SharedPtr& group) {
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
