// SPDX-License-Identifier: Apache-2.0
// Sends a number and a text. It uses memory of the middleware if the type of the message allows that.
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/float64.hpp"
#include "std_msgs/msg/string.hpp"

namespace demo_nodes_cpp {

class LoanedMessageTalker : public rclcpp::Node {
 public:
  explicit LoanedMessageTalker(const rclcpp::NodeOptions& options) : Node("loaned_message_talker", options) {
    number_publisher_ = create_publisher<std_msgs::msg::Float64>("chatter_pod", 7);
    text_publisher_ = create_publisher<std_msgs::msg::String>("chatter", 7);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { send(); });
  }

 private:
  void send() {
    // The middleware owns the memory of this message. For subscriptions that share it, nothing is copied.
    auto number = number_publisher_->borrow_loaned_message();
    number.get().data = static_cast<double>(count_++);
    RCLCPP_INFO(get_logger(), "Publishing: '%f'", number.get().data);
    number_publisher_->publish(std::move(number));

    // A text has no fixed size, so its memory comes from the publisher's allocator.
    auto text = text_publisher_->borrow_loaned_message();
    text.get().data = "Hello World: " + std::to_string(count_++);
    RCLCPP_INFO(get_logger(), "Publishing: '%s'", text.get().data.c_str());
    text_publisher_->publish(std::move(text));
  }

  size_t count_ = 1;
  rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr number_publisher_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr text_publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::LoanedMessageTalker)
