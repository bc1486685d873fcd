// SPDX-License-Identifier: Apache-2.0
// The logger of a node, and the services that read and change log levels.
#pragma once

#include "rclcpp/logger.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeLoggingInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeLoggingInterface)
  virtual ~NodeLoggingInterface() = default;

  virtual Logger get_logger() const = 0;
  virtual const char* get_logger_name() const = 0;

  // Starts ~/get_logger_levels and ~/set_logger_levels, for all loggers of the process. Throws exceptions::RCLError.
  virtual void create_logger_services(NodeServicesInterface::SharedPtr services) = 0;
};

}  // namespace rclcpp::node_interfaces
