// SPDX-License-Identifier: Apache-2.0
// Sends requests on topic ping until an answer comes on topic pong, and ends. With the argument do_more it continues.
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

class PingNode : public rclcpp::Node {
 public:
  explicit PingNode(bool do_more) : Node("test_ping"), do_more_(do_more) {
    subscription_ = create_subscription<std_msgs::msg::String>(
        "pong", rclcpp::QoS(10), [this](const std_msgs::msg::String& answer) { receive(answer); });
    publisher_ = create_publisher<std_msgs::msg::String>("ping", rclcpp::QoS(10).transient_local());
    timer_ = create_wall_timer(std::chrono::milliseconds(500), [this] { ask(); });
  }

 private:
  // An answer is lost if the other node has not discovered this subscription yet. So ask again until one arrives.
  void ask() {
    std_msgs::msg::String question;
    question.data = "are you there?";
    RCLCPP_INFO(get_logger(), "ping");
    publisher_->publish(question);
  }

  void receive(const std_msgs::msg::String& answer) {
    RCLCPP_INFO(get_logger(), "[output] %s", answer.data.c_str());
    if (!do_more_) {
      rclcpp::shutdown();
    }
  }

  bool do_more_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    rclcpp::spin(std::make_shared<PingNode>(arguments.size() > 1 && arguments[1] == "do_more"));
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "test_ping: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
