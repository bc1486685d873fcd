// Drives clocks from the topic /clock while a node's parameter use_sim_time is true.
//
// A node's own clock needs none: each node has one. The messages come through the node's default callback group:
// simulated time advances while the node is spun.
#pragma once

#include <memory>

#include "rclcpp/clock.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

// Thread safe.
class TimeSource {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(TimeSource)

  // `use_clock_thread` has no effect: there is no thread of its own.
  explicit TimeSource(const QoS& qos = ClockQoS(), bool use_clock_thread = true);
  explicit TimeSource(const Node::SharedPtr& node, const QoS& qos = ClockQoS(), bool use_clock_thread = true);
  ~TimeSource();

  // Replaces the former node. Throws what creating a subscription throws.
  void attachNode(const Node::SharedPtr& node);
  void detachNode();

  // Throws std::invalid_argument unless the clock's type is RCL_ROS_TIME.
  void attachClock(const Clock::SharedPtr& clock);
  // The clock goes on with the system's time.
  void detachClock(const Clock::SharedPtr& clock);

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
