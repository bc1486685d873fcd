// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_msgs/msg/int64.hpp>

namespace companion_part {

// Says that it is there, and counts on a topic.
class Part : public rclcpp::Node {
 public:
  explicit Part(const rclcpp::NodeOptions& options) : rclcpp::Node("part", options) {
    declare_parameter("gain", 1.0);
    publisher_ = create_publisher<std_msgs::msg::Int64>("numbers", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(50), [this] {
      std_msgs::msg::Int64 message;
      message.data = ++count_;
      publisher_->publish(message);
    });
    RCLCPP_INFO(get_logger(), "the part is loaded");
  }

 private:
  rclcpp::Publisher<std_msgs::msg::Int64>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
  int count_ = 0;
};

}  // namespace companion_part

RCLCPP_COMPONENTS_REGISTER_NODE(companion_part::Part)
