// SPDX-License-Identifier: Apache-2.0
// Keeps frames up to date from the topics /tf and /tf_static.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "rclcpp/rclcpp.hpp"
#include "tf2_msgs/msg/tf_message.hpp"
#include "track_frames/frames.hpp"

namespace track_frames_ros {

// The QoS that parameters of the node may change.
template <class AllocatorT = std::allocator<void>>
rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> listener_options() {
  rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> options;
  options.qos_overriding_options =
      rclcpp::QosOverridingOptions{rclcpp::QosPolicyKind::Depth, rclcpp::QosPolicyKind::Durability,
                                   rclcpp::QosPolicyKind::History, rclcpp::QosPolicyKind::Reliability};
  return options;
}

class Listener {
 public:
  // With a node of its own.
  explicit Listener(track_frames::Frames& frames) : frames_(frames) {
    rclcpp::NodeOptions options;
    options.arguments({"--ros-args", "-r", std::string("__node:=listener_") + std::to_string(++count())});
    options.start_parameter_event_publisher(false);
    options.start_parameter_services(false);
    own_node_ = rclcpp::Node::make_shared("_", options);
    start(own_node_->get_node_base_interface(), own_node_->get_node_parameters_interface(),
          own_node_->get_node_topics_interface());
  }
  // With the interfaces of a node of any class, in a thread of its own.
  template <class NodeT>
  Listener(track_frames::Frames& frames, NodeT&& node) : frames_(frames) {
    start(node->get_node_base_interface(), node->get_node_parameters_interface(), node->get_node_topics_interface());
  }
  ~Listener() {
    // Without the promise, a cancel() before the thread has begun to spin would be lost.
    done_.set_value();
    executor_->cancel();
    thread_.join();
  }

 private:
  using Interfaces = rclcpp::node_interfaces::NodeInterfaces<rclcpp::node_interfaces::NodeParametersInterface,
                                                             rclcpp::node_interfaces::NodeTopicsInterface>;

  void start(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base,
             rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters,
             rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics) {
    group_ = base->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    auto options = listener_options();
    options.callback_group = group_;
    const auto subscribe = [&](const char* topic, const rclcpp::QoS& qos, bool is_static) {
      return rclcpp::create_subscription<tf2_msgs::msg::TFMessage>(
          parameters, topics, topic, qos,
          [this, is_static](const tf2_msgs::msg::TFMessage::ConstSharedPtr message) {
            for (const auto& transform : message->transforms) {
              frames_.set(transform, is_static);
            }
          },
          options);
    };
    moving_ = subscribe("/tf", rclcpp::QoS(100), false);
    fixed_ = subscribe("/tf_static", rclcpp::QoS(100).transient_local(), true);
    executor_ = rclcpp::executors::SingleThreadedExecutor::make_shared();
    executor_->add_callback_group(group_, base);
    thread_ = std::thread(
        [executor = executor_, done = done_.get_future().share()] { executor->spin_until_future_complete(done); });
  }
  static int& count() {
    static int made = 0;
    return made;
  }

  track_frames::Frames& frames_;
  rclcpp::Node::SharedPtr own_node_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr moving_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr fixed_;
  rclcpp::executors::SingleThreadedExecutor::SharedPtr executor_;
  std::promise<void> done_;
  std::thread thread_;
};

// Frames that forget what moves when the time of their clock jumps back.
class Buffer : public track_frames::Frames {
 public:
  explicit Buffer(const rclcpp::Clock::SharedPtr& clock) : clock_(clock) {
    rcl_jump_threshold_t threshold;
    threshold.on_clock_change = true;
    threshold.min_backward.nanoseconds = -1;
    threshold.min_forward.nanoseconds = 0;
    handler_ = clock_->create_jump_callback(
        nullptr,
        [this](const rcl_time_jump_t& jump) {
          if (jump.clock_change == RCL_ROS_TIME_NO_CHANGE && jump.delta.nanoseconds < 0) {
            clear();
          }
        },
        threshold);
  }

 private:
  rclcpp::Clock::SharedPtr clock_;
  rclcpp::JumpHandler::SharedPtr handler_;
};

class Broadcaster {
 public:
  template <class NodeT>
  explicit Broadcaster(NodeT&& node, bool is_static = false)
      : publisher_(rclcpp::create_publisher<tf2_msgs::msg::TFMessage>(
            node, is_static ? "/tf_static" : "/tf", is_static ? rclcpp::QoS(1).transient_local() : rclcpp::QoS(100))) {}
  void send(const geometry_msgs::msg::TransformStamped& transform) {
    tf2_msgs::msg::TFMessage message;
    message.transforms.push_back(transform);
    publisher_->publish(message);
  }

 private:
  rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr publisher_;
};

}  // namespace track_frames_ros
