// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <future>
#include <mutex>
#include <nav_msgs/msg/occupancy_grid.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "track_navigator/layer.hpp"

namespace track_navigator {

class StaticLayer : public Layer {
 public:
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, const std::string& name,
                 const std::shared_ptr<track_frames_ros::Buffer>& frames) override {
    const auto node = parent.lock();
    if (!node) {
      throw std::runtime_error("Failed to lock node");
    }
    frames_ = frames;
    const std::string topic = node->declare_parameter<std::string>(name + ".map_topic", "map");
    group_ = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    subscription_ = node->create_subscription<nav_msgs::msg::OccupancyGrid>(
        topic, rclcpp::QoS(1).transient_local().reliable(),
        [this](const nav_msgs::msg::OccupancyGrid::SharedPtr map) {
          const std::lock_guard<std::mutex> lock(mutex_);
          costs_.assign(map->data.begin(), map->data.end());
        },
        options);
    executor_.add_callback_group(group_, node->get_node_base_interface());
  }
  void activate() override {
    done_ = std::promise<void>();
    thread_ = std::thread([this, done = done_.get_future()] { executor_.spin_until_future_complete(done); });
  }
  void deactivate() override {
    // Without the promise, a cancel() before the thread has begun to spin would be lost.
    done_.set_value();
    executor_.cancel();
    thread_.join();
  }
  void cleanup() override { subscription_.reset(); }
  void update(Costs& costs) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    costs = costs_;
  }

 private:
  std::shared_ptr<track_frames_ros::Buffer> frames_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::promise<void> done_;
  std::thread thread_;
  std::mutex mutex_;
  Costs costs_;
  rclcpp::Subscription<nav_msgs::msg::OccupancyGrid>::SharedPtr subscription_;
};

class InflationLayer : public Layer {
 public:
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, const std::string& name,
                 const std::shared_ptr<track_frames_ros::Buffer>&) override {
    const auto node = parent.lock();
    node->declare_parameter(name + ".radius", rclcpp::ParameterValue(1));
    node->get_parameter(name + ".radius", radius_);
    handler_ = node->add_on_set_parameters_callback([this, name](const std::vector<rclcpp::Parameter>& parameters) {
      rcl_interfaces::msg::SetParametersResult result;
      result.successful = true;
      for (const auto& parameter : parameters) {
        if (parameter.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER &&
            parameter.get_name() == name + ".radius") {
          radius_ = static_cast<int>(parameter.as_int());
        }
      }
      return result;
    });
  }
  void activate() override {}
  void deactivate() override {}
  void cleanup() override { handler_.reset(); }
  void update(Costs& costs) override {
    const Costs before = costs;
    for (int i = 0; i < static_cast<int>(costs.size()); ++i) {
      for (int j = std::max(0, i - radius_); j <= std::min(static_cast<int>(costs.size()) - 1, i + radius_); ++j) {
        costs[i] = std::max(costs[i], before[j]);
      }
    }
  }

 private:
  int radius_ = 0;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr handler_;
};

}  // namespace track_navigator

PLUGINLIB_EXPORT_CLASS(track_navigator::StaticLayer, track_navigator::Layer)
PLUGINLIB_EXPORT_CLASS(track_navigator::InflationLayer, track_navigator::Layer)
