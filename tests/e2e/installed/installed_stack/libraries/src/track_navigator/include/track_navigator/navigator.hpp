// SPDX-License-Identifier: Apache-2.0
// A lifecycle node with an action server, whose layers are plugins that its parameters name.
#pragma once

#include <example_interfaces/action/fibonacci.hpp>
#include <memory>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include "rclcpp_action/rclcpp_action.hpp"
#include "track_bond/bond.hpp"
#include "track_diagnostics/updater.hpp"
#include "track_navigator/layer.hpp"

namespace track_navigator {

class Navigator : public rclcpp_lifecycle::LifecycleNode {
 public:
  using Action = example_interfaces::action::Fibonacci;
  using GoalHandle = rclcpp_action::ServerGoalHandle<Action>;
  using CallbackReturn = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;

  explicit Navigator(const rclcpp::NodeOptions& options = rclcpp::NodeOptions());
  ~Navigator() override;

  CallbackReturn on_configure(const rclcpp_lifecycle::State& state) override;
  CallbackReturn on_activate(const rclcpp_lifecycle::State& state) override;
  CallbackReturn on_deactivate(const rclcpp_lifecycle::State& state) override;
  CallbackReturn on_cleanup(const rclcpp_lifecycle::State& state) override;
  CallbackReturn on_shutdown(const rclcpp_lifecycle::State& state) override;

 private:
  rclcpp_action::GoalResponse handle_goal(const rclcpp_action::GoalUUID& id, std::shared_ptr<const Action::Goal> goal);
  void compute(const std::shared_ptr<GoalHandle>& goal);
  void release();

  pluginlib::ClassLoader<Layer> loader_;
  std::shared_ptr<track_frames_ros::Buffer> frames_;
  std::unique_ptr<track_frames_ros::Listener> listener_;
  std::vector<Layer::Ptr> layers_;
  std::unique_ptr<track_diagnostics::Updater> diagnostics_;
  std::unique_ptr<track_bond::Bond> bond_;
  rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::Header>::SharedPtr publisher_;
  rclcpp_action::Server<Action>::SharedPtr server_;
  std::thread worker_;
};

}  // namespace track_navigator
