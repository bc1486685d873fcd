// SPDX-License-Identifier: Apache-2.0
// Creates clients of services whose type is given by name, for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/generic_client.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp {

// `service_type` looks like "std_srvs/srv/SetBool". Throws what the constructor of GenericClient throws.
GenericClient::SharedPtr create_generic_client(std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
                                               std::shared_ptr<node_interfaces::NodeGraphInterface> node_graph,
                                               std::shared_ptr<node_interfaces::NodeServicesInterface> node_services,
                                               const std::string& service_name, const std::string& service_type,
                                               const QoS& qos = ServicesQoS(),
                                               CallbackGroup::SharedPtr group = nullptr);

// `node` is a Node, a pointer to one, or a similar class.
template <typename NodeT>
GenericClient::SharedPtr create_generic_client(NodeT node, const std::string& service_name,
                                               const std::string& service_type, const QoS& qos = ServicesQoS(),
                                               CallbackGroup::SharedPtr group = nullptr) {
  return create_generic_client(node->get_node_base_interface(), node->get_node_graph_interface(),
                               node->get_node_services_interface(), service_name, service_type, qos, group);
}

}  // namespace rclcpp
