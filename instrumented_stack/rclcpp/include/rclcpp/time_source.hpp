// SPDX-License-Identifier: Apache-2.0
// Drives clocks from the topic /clock while a node's parameter use_sim_time is true.
//
// Every node already has a time source for its own clock. By default a thread receives the messages. It runs as long as
// time is simulated, so time advances even if the node is not spun. A program can then sleep until a simulated time
// anywhere.
#pragma once

#include <memory>
#include <rosgraph_msgs/msg/clock.hpp>

#include "rclcpp/clock.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

// Thread safe.
class TimeSource {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(TimeSource)

  // Without a thread, messages come through the node's default callback group, while the node is spun.
  explicit TimeSource(const QoS& qos = ClockQoS(), bool use_clock_thread = true);
  explicit TimeSource(const Node::SharedPtr& node, const QoS& qos = ClockQoS(), bool use_clock_thread = true);
  ~TimeSource();

  // Replaces the former node. Declares use_sim_time unless it is declared. Keeps the interfaces alive. Throws what
  // creating a subscription throws, and exceptions::InvalidParameterTypeException if the parameter is not a bool.
  void attachNode(const Node::SharedPtr& node);
  void attachNode(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                  node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                  node_interfaces::NodeGraphInterface::SharedPtr node_graph,
                  node_interfaces::NodeServicesInterface::SharedPtr node_services,
                  node_interfaces::NodeLoggingInterface::SharedPtr node_logging,
                  node_interfaces::NodeClockInterface::SharedPtr node_clock,
                  node_interfaces::NodeParametersInterface::SharedPtr node_parameters);
  void detachNode();

  // Throws std::invalid_argument unless the clock's type is RCL_ROS_TIME.
  void attachClock(const Clock::SharedPtr& clock);
  // The clock continues with the system's time.
  void detachClock(const Clock::SharedPtr& clock);

  // Takes effect when time is next simulated.
  bool get_use_clock_thread();
  void set_use_clock_thread(bool use_clock_thread);
  // Whether the thread runs.
  bool clock_thread_is_joinable();

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
