// SPDX-License-Identifier: Apache-2.0
// Talker and listener on topic chatter that work with the bytes of messages.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/string.hpp"

namespace demo_nodes_cpp {

namespace {

std::string hexadecimal(const rclcpp::SerializedMessage& message) {
  const auto& bytes = message.get_rcl_serialized_message();
  std::string text;
  for (size_t i = 0; i < bytes.buffer_length; ++i) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%02x ", bytes.buffer[i]);
    text += digits;
  }
  return text;
}

}  // namespace

class SerializedMessageTalker : public rclcpp::Node {
 public:
  explicit SerializedMessageTalker(const rclcpp::NodeOptions& options) : Node("serialized_message_talker", options) {
    publisher_ = create_publisher<std_msgs::msg::String>("chatter", 7);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { say_hello(); });
  }

 private:
  void say_hello() {
    std_msgs::msg::String message;
    message.data = "Hello World:" + std::to_string(count_++);
    rclcpp::SerializedMessage bytes;
    serialization_.serialize_message(&message, &bytes);
    std::printf("ROS message:\n%s\nserialized message:\n%s\n", message.data.c_str(), hexadecimal(bytes).c_str());
    std::fflush(stdout);
    publisher_->publish(bytes);
  }

  size_t count_ = 1;
  rclcpp::Serialization<std_msgs::msg::String> serialization_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

class SerializedMessageListener : public rclcpp::Node {
 public:
  explicit SerializedMessageListener(const rclcpp::NodeOptions& options)
      : Node("serialized_message_listener", options) {
    subscription_ = create_subscription<std_msgs::msg::String>(
        "chatter", 10, [this](const std::shared_ptr<const rclcpp::SerializedMessage> bytes) { print(*bytes); });
  }

 private:
  void print(const rclcpp::SerializedMessage& bytes) const {
    std_msgs::msg::String message;
    serialization_.deserialize_message(&bytes, &message);
    std::printf("I heard data of length: %zu\n%s\nserialized data after deserialization: %s\n", bytes.size(),
                hexadecimal(bytes).c_str(), message.data.c_str());
    std::fflush(stdout);
  }

  rclcpp::Serialization<std_msgs::msg::String> serialization_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::SerializedMessageTalker)
RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::SerializedMessageListener)
