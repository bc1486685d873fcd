// SPDX-License-Identifier: Apache-2.0
// The service `~/get_type_description` of a node.
#pragma once

#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_interfaces/node_type_descriptions_interface.hpp"
#include "rclcpp/service_base.hpp"

namespace rclcpp::node_interfaces {

// It exists unless the parameter start_type_description_service, which is declared here, is false. It describes the
// types of the node's current publishers, subscriptions, services, clients and actions, by their hash.
class NodeTypeDescriptions : public NodeTypeDescriptionsInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTypeDescriptions)

  NodeTypeDescriptions(const NodeBaseInterface::SharedPtr& node_base,
                       const NodeParametersInterface::SharedPtr& parameters,
                       const NodeServicesInterface::SharedPtr& services);

 private:
  ServiceBase::SharedPtr service_;
};

}  // namespace rclcpp::node_interfaces
