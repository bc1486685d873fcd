// SPDX-License-Identifier: Apache-2.0
// Sends every number that arrives on topic ping back on topic pong.
//
// Parameter: count  end after the reply to this number (default 0: until interrupted)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int64.hpp"

class Pong : public rclcpp::Node {
 public:
  Pong() : Node("pong") {
    count_ = declare_parameter("count", 0);

    subscription_ = create_subscription<std_msgs::msg::Int64>(
        "ping", 10, [this](const std_msgs::msg::Int64& message) { answer(message); });
    publisher_ = create_publisher<std_msgs::msg::Int64>("pong", 10);
  }

 private:
  // The maximum time for the last reply to arrive.
  static constexpr std::chrono::seconds kAcknowledgementTimeout{2};

  void answer(const std_msgs::msg::Int64& message) {
    publisher_->publish(message);
    RCLCPP_INFO(get_logger(), "pong %ld", static_cast<long>(message.data));
    if (message.data == count_) {
      if (!publisher_->wait_for_all_acked(kAcknowledgementTimeout)) {
        RCLCPP_WARN(get_logger(), "nobody acknowledged the last reply");
      }
      rclcpp::shutdown();
    }
  }

  int64_t count_ = 0;

  rclcpp::Subscription<std_msgs::msg::Int64>::SharedPtr subscription_;
  rclcpp::Publisher<std_msgs::msg::Int64>::SharedPtr publisher_;
};

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<Pong>());
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pong: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
