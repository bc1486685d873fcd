// SPDX-License-Identifier: Apache-2.0
// Adds services and clients to callback groups, where executors find them.
#pragma once

#include <string>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/service_base.hpp"

namespace rclcpp::node_interfaces {

class NodeServices {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeServices)

  explicit NodeServices(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Null means the default group. Throw std::runtime_error if the group belongs to another node.
  void add_service(const ServiceBase::SharedPtr& service, const CallbackGroup::SharedPtr& group);
  void add_client(const ClientBase::SharedPtr& client, const CallbackGroup::SharedPtr& group);

  // Expands the name and, unless `only_expand`, remaps it.
  std::string resolve_service_name(const std::string& name, bool only_expand = false) const {
    return node_base_->resolve_topic_or_service_name(name, true, only_expand);
  }

  const NodeBaseInterface::SharedPtr& get_node_base_interface() const { return node_base_; }

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeServicesInterface = NodeServices;

}  // namespace rclcpp::node_interfaces
