// SPDX-License-Identifier: Apache-2.0
// One end of a bond. It breaks when the beats of the other end stay away, or when that end breaks it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "track_bond/msg/status.hpp"

namespace track_bond {

class Bond {
 public:
  using Clock = rclcpp::Clock;

  Bond(const std::string& topic, const std::string& id, rclcpp_lifecycle::LifecycleNode::SharedPtr node,
       std::function<void()> on_broken, std::function<void()> on_formed = nullptr);
  Bond(const std::string& topic, const std::string& id, rclcpp::Node::SharedPtr node, std::function<void()> on_broken,
       std::function<void()> on_formed = nullptr);
  ~Bond();
  Bond(const Bond&) = delete;
  Bond& operator=(const Bond&) = delete;

  void start(std::chrono::milliseconds beat, std::chrono::milliseconds timeout);
  void break_bond();
  bool is_formed() const;

 private:
  Bond(const std::string& topic, const std::string& id, rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base,
       rclcpp::node_interfaces::NodeTimersInterface::SharedPtr timers,
       rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters,
       rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics, std::function<void()> on_broken,
       std::function<void()> on_formed);
  void heard(const msg::Status& status);
  void publish(bool active);
  void ended();

  const std::string id_;
  const std::string instance_id_;
  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base_;
  rclcpp::node_interfaces::NodeTimersInterface::SharedPtr timers_;
  rclcpp::Publisher<msg::Status>::SharedPtr publisher_;
  rclcpp::Subscription<msg::Status>::SharedPtr subscription_;
  rclcpp::TimerBase::SharedPtr beat_;
  rclcpp::TimerBase::SharedPtr timeout_;
  const std::function<void()> on_broken_;
  const std::function<void()> on_formed_;
  mutable std::mutex mutex_;
  bool formed_ = false;
  bool broken_ = false;
};

}  // namespace track_bond
