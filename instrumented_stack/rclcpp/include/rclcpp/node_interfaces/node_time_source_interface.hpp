// SPDX-License-Identifier: Apache-2.0
// Stands for what drives the clock of a node from the topic /clock. It has no functions.
#pragma once

#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeTimeSourceInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTimeSourceInterface)
  virtual ~NodeTimeSourceInterface() = default;
};

}  // namespace rclcpp::node_interfaces
