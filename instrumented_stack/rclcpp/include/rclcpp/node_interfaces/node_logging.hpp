// SPDX-License-Identifier: Apache-2.0
// The logger of a node.
#pragma once

#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeLogging : public NodeLoggingInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeLogging)

  explicit NodeLogging(NodeBaseInterface::SharedPtr node_base);

  Logger get_logger() const override { return logger_; }
  const char* get_logger_name() const override { return logger_.get_name(); }
  void create_logger_services(NodeServicesInterface::SharedPtr services) override;

 private:
  NodeBaseInterface::SharedPtr node_base_;
  Logger logger_;
  ServiceBase::SharedPtr get_levels_;
  ServiceBase::SharedPtr set_levels_;
};

}  // namespace rclcpp::node_interfaces
