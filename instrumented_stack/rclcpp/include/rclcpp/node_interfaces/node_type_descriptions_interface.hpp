// SPDX-License-Identifier: Apache-2.0
// Stands for the service `~/get_type_description` of a node. It has no functions.
#pragma once

#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeTypeDescriptionsInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTypeDescriptionsInterface)
  virtual ~NodeTypeDescriptionsInterface() = default;
};

}  // namespace rclcpp::node_interfaces
