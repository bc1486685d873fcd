// SPDX-License-Identifier: Apache-2.0
// Adds services and clients to callback groups, where executors find them.
#pragma once

#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/service_base.hpp"

namespace rclcpp::node_interfaces {

class NodeServicesInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeServicesInterface)
  virtual ~NodeServicesInterface() = default;

  // Null means the default group. Throw std::runtime_error if the group belongs to another node.
  virtual void add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) = 0;
  virtual void add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) = 0;

  // Expands the name and, unless `only_expand`, remaps it.
  virtual std::string resolve_service_name(const std::string& name, bool only_expand = false) const = 0;
};

}  // namespace rclcpp::node_interfaces
