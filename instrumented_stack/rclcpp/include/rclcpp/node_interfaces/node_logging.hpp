// SPDX-License-Identifier: Apache-2.0
// The logger of a node, and the services that read and change log levels.
#pragma once

#include <utility>

#include "rclcpp/logger.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_services.hpp"

namespace rclcpp::node_interfaces {

class NodeLogging {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeLogging)

  explicit NodeLogging(Logger logger) : logger_(std::move(logger)) {}

  Logger get_logger() const { return logger_; }
  const char* get_logger_name() const { return logger_.get_name(); }

  // Starts ~/get_logger_levels and ~/set_logger_levels, for all loggers of the process. Throws exceptions::RCLError.
  void create_logger_services(const NodeServicesInterface::SharedPtr& services);

 private:
  Logger logger_;
  ServiceBase::SharedPtr get_levels_;
  ServiceBase::SharedPtr set_levels_;
};

using NodeLoggingInterface = NodeLogging;

}  // namespace rclcpp::node_interfaces
