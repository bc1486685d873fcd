// SPDX-License-Identifier: Apache-2.0
// Creates clients for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/client.hpp"
#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp {

template <typename ServiceT>
typename Client<ServiceT>::SharedPtr create_client(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
    std::shared_ptr<node_interfaces::NodeServicesInterface> node_services, const std::string& service_name,
    const QoS& qos = ServicesQoS(), CallbackGroup::SharedPtr group = nullptr) {
  auto client = std::make_shared<Client<ServiceT>>(node_base.get(), service_name, qos);
  node_services->add_client(client, group);
  return client;
}

// Like the function above; the graph is not needed.
template <typename ServiceT>
typename Client<ServiceT>::SharedPtr create_client(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
    std::shared_ptr<node_interfaces::NodeGraphInterface> /*node_graph*/,
    std::shared_ptr<node_interfaces::NodeServicesInterface> node_services, const std::string& service_name,
    const QoS& qos = ServicesQoS(), CallbackGroup::SharedPtr group = nullptr) {
  return create_client<ServiceT>(std::move(node_base), std::move(node_services), service_name, qos, std::move(group));
}

// The older form, which takes a profile of the middleware.
template <typename ServiceT>
[[deprecated("use rclcpp::QoS instead of rmw_qos_profile_t")]] typename Client<ServiceT>::SharedPtr create_client(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
    std::shared_ptr<node_interfaces::NodeGraphInterface> /*node_graph*/,
    std::shared_ptr<node_interfaces::NodeServicesInterface> node_services, const std::string& service_name,
    const rmw_qos_profile_t& qos_profile, CallbackGroup::SharedPtr group) {
  return create_client<ServiceT>(std::move(node_base), std::move(node_services), service_name,
                                 QoS(QoSInitialization::from_rmw(qos_profile), qos_profile), std::move(group));
}

// `node` is a Node, a pointer to one, or a similar class.
template <typename ServiceT, typename NodeT>
typename Client<ServiceT>::SharedPtr create_client(NodeT& node, const std::string& service_name,
                                                   const QoS& qos = ServicesQoS(),
                                                   CallbackGroup::SharedPtr group = nullptr) {
  auto& actual_node = node_interfaces::dereferenced(node);
  return create_client<ServiceT>(actual_node.get_node_base_interface(), actual_node.get_node_services_interface(),
                                 service_name, qos, std::move(group));
}

}  // namespace rclcpp
