// SPDX-License-Identifier: Apache-2.0
// A listener that has a node but is none: a component needs only get_node_base_interface().
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class NodeLikeListener {
 public:
  explicit NodeLikeListener(const rclcpp::NodeOptions& options);

  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() const;

 private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

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
