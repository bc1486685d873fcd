// SPDX-License-Identifier: Apache-2.0
#include "composition/node_like_listener_component.hpp"

#include <memory>

#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

NodeLikeListener::NodeLikeListener(const rclcpp::NodeOptions& options)
    : node_(std::make_shared<rclcpp::Node>("node_like_listener", options)) {
  subscription_ = node_->create_subscription<std_msgs::msg::String>(
      "chatter", 10, [logger = node_->get_logger()](const std_msgs::msg::String& message) {
        RCLCPP_INFO(logger, "I heard: [%s]", message.data.c_str());
      });
}

rclcpp::node_interfaces::NodeBaseInterface::SharedPtr NodeLikeListener::get_node_base_interface() const {
  return node_->get_node_base_interface();
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::NodeLikeListener)
