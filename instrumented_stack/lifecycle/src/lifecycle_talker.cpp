// SPDX-License-Identifier: Apache-2.0
#include "lifecycle/lifecycle_talker.hpp"

#include <chrono>
#include <string>

#include "rclcpp_components/register_node_macro.hpp"

namespace lifecycle {

using rclcpp_lifecycle::State;

LifecycleTalker::LifecycleTalker(const rclcpp::NodeOptions& options) : LifecycleNode("lc_talker", options) {
  declare_parameter("period_ms", 1000);
}

LifecycleTalker::CallbackReturn LifecycleTalker::on_configure(const State&) {
  publisher_ = create_publisher<std_msgs::msg::String>("lifecycle_chatter", 10);
  // The timer runs from now on. While the node is inactive the publisher drops the messages.
  timer_ = create_wall_timer(std::chrono::milliseconds(get_parameter("period_ms").as_int()), [this] { say_hello(); });
  RCLCPP_INFO(get_logger(), "on_configure() is called.");
  return CallbackReturn::SUCCESS;
}

LifecycleTalker::CallbackReturn LifecycleTalker::on_activate(const State& previous_state) {
  RCLCPP_INFO(get_logger(), "on_activate() is called.");
  return LifecycleNode::on_activate(previous_state);  // switches the publisher on
}

LifecycleTalker::CallbackReturn LifecycleTalker::on_deactivate(const State& previous_state) {
  RCLCPP_INFO(get_logger(), "on_deactivate() is called.");
  return LifecycleNode::on_deactivate(previous_state);
}

LifecycleTalker::CallbackReturn LifecycleTalker::on_cleanup(const State&) {
  release();
  RCLCPP_INFO(get_logger(), "on cleanup is called.");
  return CallbackReturn::SUCCESS;
}

LifecycleTalker::CallbackReturn LifecycleTalker::on_shutdown(const State& previous_state) {
  release();
  RCLCPP_INFO(get_logger(), "on shutdown is called from state %s.", previous_state.label().c_str());
  return CallbackReturn::SUCCESS;
}

void LifecycleTalker::say_hello() {
  std_msgs::msg::String message;
  message.data = "Lifecycle HelloWorld #" + std::to_string(++count_);
  if (publisher_->is_activated()) {
    RCLCPP_INFO(get_logger(), "Lifecycle publisher is active. Publishing: [%s]", message.data.c_str());
  } else {
    RCLCPP_INFO(get_logger(), "Lifecycle publisher is currently inactive. Messages are not published.");
  }
  publisher_->publish(message);
}

void LifecycleTalker::release() {
  timer_.reset();
  publisher_.reset();
}

}  // namespace lifecycle

RCLCPP_COMPONENTS_REGISTER_NODE(lifecycle::LifecycleTalker)
