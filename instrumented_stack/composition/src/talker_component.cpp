// SPDX-License-Identifier: Apache-2.0
// Says hello on topic chatter once a second.
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class Talker : public rclcpp::Node {
 public:
  explicit Talker(const rclcpp::NodeOptions& options);

 private:
  void say_hello();

  size_t count_ = 0;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

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
