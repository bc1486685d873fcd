// SPDX-License-Identifier: Apache-2.0
// The six services that read and change the parameters of a node.
#pragma once

#include <vector>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/service_base.hpp"

namespace rclcpp {

namespace node_interfaces {
class NodeParametersInterface;
}

// `<node>/get_parameters`, get_parameter_types, set_parameters, set_parameters_atomically, describe_parameters and
// list_parameters, of rcl_interfaces. For undeclared parameters the response is empty, or a result contains the reason.
class ParameterService {
 public:
  // `node_parameters` must outlive the services and the executor that runs them.
  ParameterService(const node_interfaces::NodeBaseInterface::SharedPtr& node_base,
                   const node_interfaces::NodeServicesInterface::SharedPtr& node_services,
                   node_interfaces::NodeParametersInterface* node_parameters, const QoS& qos = ParametersQoS());

 private:
  std::vector<ServiceBase::SharedPtr> services_;
};

}  // namespace rclcpp
