// SPDX-License-Identifier: Apache-2.0
// Asks its tasks for their state, as often as a parameter says, and publishes it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "diagnostic_msgs/msg/diagnostic_array.hpp"
#include "diagnostic_msgs/msg/key_value.hpp"
#include "rclcpp/create_timer.hpp"
#include "rclcpp/rclcpp.hpp"

namespace track_diagnostics {

// A status with functions beside the members of the message.
class Status : public diagnostic_msgs::msg::DiagnosticStatus {
 public:
  void summary(unsigned char new_level, const std::string& new_message) {
    level = new_level;
    message = new_message;
  }
  template <class T>
  void add(const std::string& key, const T& value) {
    values.push_back(diagnostic_msgs::build<diagnostic_msgs::msg::KeyValue>().key(key).value(std::to_string(value)));
  }
};

class Updater {
 public:
  template <class NodeT>
  explicit Updater(NodeT node, double period = 1.0)
      : Updater(node->get_node_base_interface(), node->get_node_clock_interface(), node->get_node_logging_interface(),
                node->get_node_parameters_interface(), node->get_node_timers_interface(),
                node->get_node_topics_interface(), period) {}

  Updater(const std::shared_ptr<rclcpp::node_interfaces::NodeBaseInterface>& base,
          const std::shared_ptr<rclcpp::node_interfaces::NodeClockInterface>& clock,
          const std::shared_ptr<rclcpp::node_interfaces::NodeLoggingInterface>& logging,
          std::shared_ptr<rclcpp::node_interfaces::NodeParametersInterface> parameters,
          std::shared_ptr<rclcpp::node_interfaces::NodeTimersInterface> timers,
          std::shared_ptr<rclcpp::node_interfaces::NodeTopicsInterface> topics, double period)
      : base_(base),
        clock_(clock->get_clock()),
        logger_(logging->get_logger()),
        timers_(timers),
        period_(rclcpp::Duration::from_seconds(period)),
        publisher_(rclcpp::create_publisher<diagnostic_msgs::msg::DiagnosticArray>(topics, "/diagnostics", 1)) {
    constexpr const char* kPeriod = "diagnostic_updater.period";
    rclcpp::ParameterValue value;
    if (parameters->has_parameter(kPeriod)) {
      value = parameters->get_parameter(kPeriod).get_parameter_value();
    } else {
      value = parameters->declare_parameter(kPeriod, rclcpp::ParameterValue(period));
    }
    period_ = rclcpp::Duration::from_seconds(value.get<double>());
    timer_ = rclcpp::create_timer(base_, timers_, clock_, period_, [this] { update(); });
  }

  void add(const std::string& name, std::function<void(Status&)> task) {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.emplace_back(name, std::move(task));
  }
  void update() {
    if (!rclcpp::ok()) {
      return;
    }
    diagnostic_msgs::msg::DiagnosticArray array;
    array.header.stamp = clock_->now();
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto& [name, task] : tasks_) {
      Status status;
      status.name = std::string(base_->get_name()) + ": " + name;
      task(status);
      if (status.level != Status::OK) {
        RCLCPP_WARN_THROTTLE(logger_, *clock_, 1000, "%s", status.message.c_str());
      }
      array.status.push_back(status);
    }
    publisher_->publish(array);
  }

 private:
  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base_;
  rclcpp::Clock::SharedPtr clock_;
  rclcpp::Logger logger_;
  std::shared_ptr<rclcpp::node_interfaces::NodeTimersInterface> timers_;
  rclcpp::Duration period_;
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::function<void(Status&)>>> tasks_;
};

}  // namespace track_diagnostics
