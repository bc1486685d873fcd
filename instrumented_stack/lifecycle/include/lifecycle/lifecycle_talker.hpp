// SPDX-License-Identifier: Apache-2.0
// A managed node that says hello on topic lifecycle_chatter while it is active.
#pragma once

#include <memory>

#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "std_msgs/msg/string.hpp"

namespace lifecycle {

// Parameter: period_ms  time between two messages (default 1000), read when the node is configured
class LifecycleTalker : public rclcpp_lifecycle::LifecycleNode {
 public:
  explicit LifecycleTalker(const rclcpp::NodeOptions& options = rclcpp::NodeOptions());

  CallbackReturn on_configure(const rclcpp_lifecycle::State& previous_state) override;
  CallbackReturn on_activate(const rclcpp_lifecycle::State& previous_state) override;
  CallbackReturn on_deactivate(const rclcpp_lifecycle::State& previous_state) override;
  CallbackReturn on_cleanup(const rclcpp_lifecycle::State& previous_state) override;
  CallbackReturn on_shutdown(const rclcpp_lifecycle::State& previous_state) override;

 private:
  void say_hello();
  void release();

  size_t count_ = 0;
  std::shared_ptr<rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::String>> publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace lifecycle
