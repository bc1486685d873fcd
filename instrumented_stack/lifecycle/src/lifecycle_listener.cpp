// SPDX-License-Identifier: Apache-2.0
// Prints the messages of node lc_talker and its transitions.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "lifecycle_msgs/msg/transition_event.hpp"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

class LifecycleListener : public rclcpp::Node {
 public:
  LifecycleListener() : Node("lc_listener") {
    messages_ = create_subscription<std_msgs::msg::String>(
        "lifecycle_chatter", 10, [this](const std_msgs::msg::String& message) {
          RCLCPP_INFO(get_logger(), "data_callback: %s", message.data.c_str());
        });
    transitions_ = create_subscription<lifecycle_msgs::msg::TransitionEvent>(
        "lc_talker/transition_event", 10, [this](const lifecycle_msgs::msg::TransitionEvent& event) {
          RCLCPP_INFO(get_logger(), "notify callback: Transition from state %s to %s", event.start_state.label.c_str(),
                      event.goal_state.label.c_str());
        });
  }

 private:
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr messages_;
  rclcpp::Subscription<lifecycle_msgs::msg::TransitionEvent>::SharedPtr transitions_;
};

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<LifecycleListener>());
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lifecycle_listener: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
