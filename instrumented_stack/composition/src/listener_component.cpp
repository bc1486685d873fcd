// SPDX-License-Identifier: Apache-2.0
#include "composition/listener_component.hpp"

#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

Listener::Listener(const rclcpp::NodeOptions& options) : Node("listener", options) {
  subscription_ =
      create_subscription<std_msgs::msg::String>("chatter", 10, [this](const std_msgs::msg::String& message) {
        RCLCPP_INFO(get_logger(), "I heard: [%s]", message.data.c_str());
      });
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::Listener)
