#include "rclcpp/node_interfaces/node_topics.hpp"

#include <stdexcept>

namespace rclcpp::node_interfaces {

void NodeTopics::add_subscription(const SubscriptionBase::SharedPtr& subscription,
                                  const CallbackGroup::SharedPtr& group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create subscription, callback group not in node.");
  }
  (group ? group : node_base_->get_default_callback_group())->add_subscription(subscription);
}

}  // namespace rclcpp::node_interfaces
