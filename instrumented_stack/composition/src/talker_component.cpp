// SPDX-License-Identifier: Apache-2.0
#include "composition/talker_component.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp_components/register_node_macro.hpp"

namespace composition {

Talker::Talker(const rclcpp::NodeOptions& options) : Node("talker", options) {
  publisher_ = create_publisher<std_msgs::msg::String>("chatter", 10);
  timer_ = create_wall_timer(std::chrono::seconds(1), [this] { say_hello(); });
}

void Talker::say_hello() {
  // A unique pointer, so that a subscription of the same process gets this message without a copy.
  auto message = std::make_unique<std_msgs::msg::String>();
  message->data = "Hello World: " + std::to_string(++count_);
  RCLCPP_INFO(get_logger(), "Publishing: '%s'", message->data.c_str());
  publisher_->publish(std::move(message));
}

}  // namespace composition

RCLCPP_COMPONENTS_REGISTER_NODE(composition::Talker)
