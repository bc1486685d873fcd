// SPDX-License-Identifier: Apache-2.0
// Drives the clock of a node from the topic /clock while its parameter use_sim_time is true.
#pragma once

#include <memory>

#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_clock_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_interfaces/node_time_source_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

class TimeSource;

namespace node_interfaces {

class NodeTimeSource : public NodeTimeSourceInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTimeSource)

  // Throws what TimeSource::attachNode() throws.
  NodeTimeSource(NodeBaseInterface::SharedPtr node_base, NodeTopicsInterface::SharedPtr node_topics,
                 NodeGraphInterface::SharedPtr node_graph, NodeServicesInterface::SharedPtr node_services,
                 NodeLoggingInterface::SharedPtr node_logging, NodeClockInterface::SharedPtr node_clock,
                 NodeParametersInterface::SharedPtr node_parameters, const QoS& qos = ClockQoS(),
                 bool use_clock_thread = true);
  ~NodeTimeSource() override;

 private:
  std::unique_ptr<TimeSource> time_source_;
};

}  // namespace node_interfaces

}  // namespace rclcpp
