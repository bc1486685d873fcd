// SPDX-License-Identifier: Apache-2.0
// Two components: a node that ends by itself, and a managed node.
#include <cstdio>

#include "rclcpp_components/register_node_macro.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "weather/msg/report.hpp"

namespace instruments {

class Barometer : public rclcpp::Node {
 public:
  explicit Barometer(const rclcpp::NodeOptions& options) : Node("barometer", options) {
    timer_ = create_wall_timer(std::chrono::milliseconds(1), [this] {
      std::printf("%s: 1013 hPa\n", get_fully_qualified_name());
      rclcpp::shutdown();
    });
  }

 private:
  rclcpp::TimerBase::SharedPtr timer_;
};

class Thermometer : public rclcpp_lifecycle::LifecycleNode {
 public:
  explicit Thermometer(const rclcpp::NodeOptions& options) : LifecycleNode("thermometer", options) {
    declare_parameter("temperature", 0.0);
  }

  CallbackReturn on_configure(const rclcpp_lifecycle::State&) override {
    reports_ = create_publisher<weather::msg::Report>("report", rclcpp::QoS(1).transient_local());
    return CallbackReturn::SUCCESS;
  }

  CallbackReturn on_activate(const rclcpp_lifecycle::State& previous_state) override {
    LifecycleNode::on_activate(previous_state);
    weather::msg::Report report;
    report.temperature = static_cast<float>(get_parameter("temperature").as_double());
    reports_->publish(report);
    return CallbackReturn::SUCCESS;
  }

 private:
  std::shared_ptr<rclcpp_lifecycle::LifecyclePublisher<weather::msg::Report>> reports_;
};

}  // namespace instruments

RCLCPP_COMPONENTS_REGISTER_NODE(instruments::Barometer)
RCLCPP_COMPONENTS_REGISTER_NODE(instruments::Thermometer)
