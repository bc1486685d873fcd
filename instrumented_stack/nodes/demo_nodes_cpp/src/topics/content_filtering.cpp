// SPDX-License-Identifier: Apache-2.0
// One node publishes temperatures, the other subscribes only to dangerous ones.
//
// Parameter of the publisher: publish_ms  time between two temperatures, in milliseconds (default 1000)
#include <chrono>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/float32.hpp"

namespace demo_nodes_cpp {

class ContentFilteringPublisher : public rclcpp::Node {
 public:
  explicit ContentFilteringPublisher(const rclcpp::NodeOptions& options)
      : Node("content_filtering_publisher", options) {
    publisher_ = create_publisher<std_msgs::msg::Float32>("temperature", 7);
    const std::chrono::milliseconds period(declare_parameter("publish_ms", 1000));
    timer_ = create_wall_timer(period, [this] { publish_next(); });
  }

 private:
  static constexpr float kColdest = -100;
  static constexpr float kHottest = 150;
  static constexpr float kStep = 10;

  void publish_next() {
    std_msgs::msg::Float32 message;
    message.data = temperature_;
    RCLCPP_INFO(get_logger(), "Publishing: '%f'", message.data);
    publisher_->publish(message);
    temperature_ = temperature_ + kStep > kHottest ? kColdest : temperature_ + kStep;
  }

  float temperature_ = kColdest;
  rclcpp::Publisher<std_msgs::msg::Float32>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

class ContentFilteringSubscriber : public rclcpp::Node {
 public:
  explicit ContentFilteringSubscriber(const rclcpp::NodeOptions& options)
      : Node("content_filtering_subscriber", options) {
    rclcpp::SubscriptionOptions subscription_options;
    auto& filter = subscription_options.content_filter_options;
    filter.filter_expression = "data < %0 OR data > %1";
    filter.expression_parameters = {std::to_string(kTooCold), std::to_string(kTooHot)};
    subscription_ = create_subscription<std_msgs::msg::Float32>(
        "temperature", 10, [this](const std_msgs::msg::Float32& message) { note(message.data); }, subscription_options);
    RCLCPP_INFO(get_logger(), "subscribed to topic \"%s\" with content filter options \"%s, {%s, %s}\"",
                subscription_->get_topic_name(), filter.filter_expression.c_str(),
                filter.expression_parameters[0].c_str(), filter.expression_parameters[1].c_str());
  }

 private:
  static constexpr float kTooCold = -30;
  static constexpr float kTooHot = 100;

  void note(float temperature) const {
    const bool is_emergency = temperature < kTooCold || temperature > kTooHot;
    RCLCPP_INFO(get_logger(), "I receive %s temperature data: [%f]", is_emergency ? "an emergency" : "a", temperature);
  }

  rclcpp::Subscription<std_msgs::msg::Float32>::SharedPtr subscription_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ContentFilteringPublisher)
RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ContentFilteringSubscriber)
