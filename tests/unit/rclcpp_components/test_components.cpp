// SPDX-License-Identifier: Apache-2.0
// Components that misbehave, or show the options with which they were made.
#include <pthread.h>

#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_msgs/msg/string.hpp>
#include <stdexcept>
#include <string>

namespace test_components {

class Throwing : public rclcpp::Node {
 public:
  explicit Throwing(const rclcpp::NodeOptions& options) : Node("throwing", options) {
    throw std::runtime_error("no such device");
  }
};

class ThrowingNoException : public rclcpp::Node {
 public:
  explicit ThrowingNoException(const rclcpp::NodeOptions& options) : Node("throwing", options) { throw 1; }
};

// Answers every message on topic `ask` with the name of the thread of its callback.
class ThreadTeller : public rclcpp::Node {
 public:
  explicit ThreadTeller(const rclcpp::NodeOptions& options) : Node("thread_teller", options) {
    publisher_ = create_publisher<std_msgs::msg::String>("thread", 10);
    subscription_ = create_subscription<std_msgs::msg::String>("ask", 10, [this](const std_msgs::msg::String&) {
      char name[16] = "";
      pthread_getname_np(pthread_self(), name, sizeof(name));
      std_msgs::msg::String message;
      message.data = name;
      publisher_->publish(message);
    });
  }

 private:
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

// Its parameters, as other nodes see them.
class Plain : public rclcpp::Node {
 public:
  explicit Plain(const rclcpp::NodeOptions& options) : Node("plain", options) {
    declare_parameter("speed", 1.5);
    declare_parameter("intra", options.use_intra_process_comms());
    declare_parameter("global", options.use_global_arguments());
  }
};

}  // namespace test_components

RCLCPP_COMPONENTS_REGISTER_NODE(test_components::Throwing)
RCLCPP_COMPONENTS_REGISTER_NODE(test_components::ThrowingNoException)
RCLCPP_COMPONENTS_REGISTER_NODE(test_components::ThreadTeller)
RCLCPP_COMPONENTS_REGISTER_NODE(test_components::Plain)
