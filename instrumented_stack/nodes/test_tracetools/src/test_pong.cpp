// SPDX-License-Identifier: Apache-2.0
// Answers one message of topic ping on topic pong, and ends. With the argument do_more it continues.
//
// Launch files of ros2_tracing start a node with this name.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

class PongNode : public rclcpp::Node {
 public:
  explicit PongNode(bool do_more) : Node("test_pong"), do_more_(do_more) {
    subscription_ = create_subscription<std_msgs::msg::String>(
        "ping", rclcpp::QoS(10).transient_local(), [this](const std_msgs::msg::String& question) { answer(question); });
    publisher_ = create_publisher<std_msgs::msg::String>("pong", rclcpp::QoS(10));
  }

 private:
  // The maximum time for the answer to arrive.
  static constexpr std::chrono::seconds kAcknowledgementTimeout{2};

  void answer(const std_msgs::msg::String& question) {
    RCLCPP_INFO(get_logger(), "[output] %s", question.data.c_str());
    if (publisher_->get_subscription_count() == 0) {
      return;  // the answer would be lost; the question comes again
    }
    std_msgs::msg::String message;
    message.data = "yes, here I am";
    RCLCPP_INFO(get_logger(), "pong");
    publisher_->publish(message);
    if (!do_more_) {
      if (!publisher_->wait_for_all_acked(kAcknowledgementTimeout)) {
        RCLCPP_WARN(get_logger(), "nobody acknowledged the answer");
      }
      rclcpp::shutdown();
    }
  }

  bool do_more_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
};

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    rclcpp::spin(std::make_shared<PongNode>(arguments.size() > 1 && arguments[1] == "do_more"));
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "test_pong: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
