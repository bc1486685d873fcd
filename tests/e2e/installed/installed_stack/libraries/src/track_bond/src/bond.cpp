// SPDX-License-Identifier: Apache-2.0
#include "track_bond/bond.hpp"

#include <atomic>
#include <utility>

namespace track_bond {

namespace {

std::string next_instance() {
  static std::atomic<int> count{0};
  return std::to_string(++count);
}

}  // namespace

Bond::Bond(const std::string& topic, const std::string& id, rclcpp_lifecycle::LifecycleNode::SharedPtr node,
           std::function<void()> on_broken, std::function<void()> on_formed)
    : Bond(topic, id, node->get_node_base_interface(), node->get_node_timers_interface(),
           node->get_node_parameters_interface(), node->get_node_topics_interface(), std::move(on_broken),
           std::move(on_formed)) {}

Bond::Bond(const std::string& topic, const std::string& id, rclcpp::Node::SharedPtr node,
           std::function<void()> on_broken, std::function<void()> on_formed)
    : Bond(topic, id, node->get_node_base_interface(), node->get_node_timers_interface(),
           node->get_node_parameters_interface(), node->get_node_topics_interface(), std::move(on_broken),
           std::move(on_formed)) {}

Bond::Bond(const std::string& topic, const std::string& id, rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base,
           rclcpp::node_interfaces::NodeTimersInterface::SharedPtr timers,
           rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters,
           rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics, std::function<void()> on_broken,
           std::function<void()> on_formed)
    : id_(id),
      instance_id_(id + "/" + base->get_name() + next_instance()),
      base_(std::move(base)),
      timers_(std::move(timers)),
      publisher_(rclcpp::create_publisher<msg::Status>(topics, topic, rclcpp::QoS(rclcpp::KeepLast(5)))),
      on_broken_(std::move(on_broken)),
      on_formed_(std::move(on_formed)) {
  subscription_ = rclcpp::create_subscription<msg::Status>(parameters, topics, topic, rclcpp::QoS(100),
                                                           [this](const msg::Status& status) { heard(status); });
}

Bond::~Bond() {
  break_bond();
}

void Bond::start(std::chrono::milliseconds beat, std::chrono::milliseconds timeout) {
  beat_ = rclcpp::create_wall_timer(
      beat, [this] { publish(true); }, nullptr, base_.get(), timers_.get());
  timeout_ = rclcpp::create_wall_timer(
      timeout, [this] { ended(); }, nullptr, base_.get(), timers_.get());
}

void Bond::break_bond() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (std::exchange(broken_, true)) {
      return;
    }
  }
  if (beat_) {
    beat_->cancel();
    timeout_->cancel();
  }
  publish(false);
}

bool Bond::is_formed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return formed_ && !broken_;
}

void Bond::heard(const msg::Status& status) {
  if (status.id != id_ || status.instance_id == instance_id_) {
    return;
  }
  if (!status.active) {
    ended();
    return;
  }
  if (timeout_) {
    timeout_->reset();
  }
  bool is_new;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_new = !std::exchange(formed_, true);
  }
  if (is_new && on_formed_) {
    on_formed_();
  }
}

void Bond::publish(bool active) {
  msg::Status status;
  status.header.stamp = rclcpp::Clock(RCL_SYSTEM_TIME).now();
  status.id = id_;
  status.instance_id = instance_id_;
  status.active = active;
  publisher_->publish(status);
}

void Bond::ended() {
  const bool was_formed = is_formed();
  break_bond();
  if (was_formed && on_broken_) {
    on_broken_();
  }
}

}  // namespace track_bond
