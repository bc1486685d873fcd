// The logger of a node, for whoever is given interfaces instead of a node.
#pragma once

#include <utility>

#include "rclcpp/logger.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeLogging {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeLogging)

  explicit NodeLogging(Logger logger) : logger_(std::move(logger)) {}

  Logger get_logger() const { return logger_; }
  const char* get_logger_name() const { return logger_.get_name(); }

 private:
  Logger logger_;
};

using NodeLoggingInterface = NodeLogging;

}  // namespace rclcpp::node_interfaces
