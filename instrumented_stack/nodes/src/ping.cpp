// SPDX-License-Identifier: Apache-2.0
// Sends numbers on topic ping, waits for each to come back on topic pong, and ends when all have come back.
//
// Parameters: count      how many replies to wait for (default 10, 0: until interrupted)
//             period_ms  time between two messages (default 500)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int64.hpp"

class Ping : public rclcpp::Node {
 public:
  Ping() : Node("ping") {
    count_ = declare_parameter("count", 10);
    const std::chrono::milliseconds period(declare_parameter("period_ms", 500));

    subscription_ = create_subscription<std_msgs::msg::Int64>(
        "pong", 10, [this](const std_msgs::msg::Int64& reply) { receive(reply); });
    publisher_ = create_publisher<std_msgs::msg::Int64>("ping", 10);
    timer_ = create_wall_timer(period, [this] { send(); });
  }

 private:
  void send() {
    // Messages that are sent before both ends have discovered each other would be lost.
    if (publisher_->get_subscription_count() == 0 || subscription_->get_publisher_count() == 0) {
      RCLCPP_INFO_ONCE(get_logger(), "waiting for pong");
      return;
    }
    std_msgs::msg::Int64 message;
    message.data = replies_ + 1;  // the same number again if the last one was not answered
    sent_ = std::chrono::steady_clock::now();
    publisher_->publish(message);
  }

  void receive(const std_msgs::msg::Int64& reply) {
    if (reply.data != replies_ + 1) {
      return;  // a second answer to a number that was sent twice
    }
    ++replies_;
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - sent_;
    RCLCPP_INFO(get_logger(), "ping %ld answered after %.3f ms", static_cast<long>(replies_), elapsed.count());
    if (replies_ == count_) {
      rclcpp::shutdown();
    }
  }

  int64_t count_ = 0;
  int64_t replies_ = 0;
  std::chrono::steady_clock::time_point sent_;

  rclcpp::Subscription<std_msgs::msg::Int64>::SharedPtr subscription_;
  rclcpp::Publisher<std_msgs::msg::Int64>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<Ping>());
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ping: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
