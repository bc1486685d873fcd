// SPDX-License-Identifier: Apache-2.0
// Prints the messages of topic chatter.
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class Listener : public rclcpp::Node {
 public:
  explicit Listener(const rclcpp::NodeOptions& options);

 private:
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

Listener::Listener(const rclcpp::NodeOptions& options) : Node("listener", options) {
  subscription_ =
      create_subscription<std_msgs::msg::String>("chatter", 10, [this](const std_msgs::msg::String& message) {
        RCLCPP_INFO(get_logger(), "I heard: [%s]", message.data.c_str());
      });
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::Listener)
