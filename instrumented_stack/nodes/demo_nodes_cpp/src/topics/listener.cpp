// SPDX-License-Identifier: Apache-2.0
// Two nodes that print the messages of topic chatter: one subscribes reliably, the other as to sensor data.
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/string.hpp"

namespace demo_nodes_cpp {

namespace {

rclcpp::Subscription<std_msgs::msg::String>::SharedPtr listen(rclcpp::Node& node, const rclcpp::QoS& qos) {
  return node.create_subscription<std_msgs::msg::String>(
      "chatter", qos, [logger = node.get_logger()](const std_msgs::msg::String& message) {
        RCLCPP_INFO(logger, "I heard: [%s]", message.data.c_str());
      });
}

}  // namespace

class Listener : public rclcpp::Node {
 public:
  explicit Listener(const rclcpp::NodeOptions& options)
      : Node("listener", options), subscription_(listen(*this, rclcpp::QoS(10))) {}

 private:
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

class ListenerBestEffort : public rclcpp::Node {
 public:
  explicit ListenerBestEffort(const rclcpp::NodeOptions& options)
      : Node("listener", options), subscription_(listen(*this, rclcpp::SensorDataQoS())) {}

 private:
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::Listener)
RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ListenerBestEffort)
