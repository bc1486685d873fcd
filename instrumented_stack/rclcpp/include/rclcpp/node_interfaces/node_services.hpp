// SPDX-License-Identifier: Apache-2.0
// Adds services and clients to the callback groups of a node.
#pragma once

#include <string>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeServices : public NodeServicesInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeServices)

  explicit NodeServices(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  void add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) override;
  void add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) override;
  std::string resolve_service_name(const std::string& name, bool only_expand = false) const override {
    return node_base_->resolve_topic_or_service_name(name, true, only_expand);
  }

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

}  // namespace rclcpp::node_interfaces
