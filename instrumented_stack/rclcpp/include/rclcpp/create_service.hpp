// SPDX-License-Identifier: Apache-2.0
// Creates services for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/service.hpp"

namespace rclcpp {

template <typename ServiceT, typename CallbackT>
typename Service<ServiceT>::SharedPtr create_service(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
    std::shared_ptr<node_interfaces::NodeServicesInterface> node_services, const std::string& service_name,
    CallbackT&& callback, const QoS& qos, CallbackGroup::SharedPtr group) {
  auto service = std::make_shared<Service<ServiceT>>(
      node_base.get(), service_name, AnyServiceCallback<ServiceT>(std::forward<CallbackT>(callback)), qos);
  node_services->add_service(service, group);
  return service;
}

// The older form, which takes a profile of the middleware.
template <typename ServiceT, typename CallbackT>
[[deprecated("use rclcpp::QoS instead of rmw_qos_profile_t")]] typename Service<ServiceT>::SharedPtr create_service(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
    std::shared_ptr<node_interfaces::NodeServicesInterface> node_services, const std::string& service_name,
    CallbackT&& callback, const rmw_qos_profile_t& qos_profile, CallbackGroup::SharedPtr group) {
  return create_service<ServiceT>(std::move(node_base), std::move(node_services), service_name,
                                  std::forward<CallbackT>(callback),
                                  QoS(QoSInitialization::from_rmw(qos_profile), qos_profile), std::move(group));
}

// `node` is a Node, a pointer to one, or a similar class.
template <typename ServiceT, typename NodeT, typename CallbackT>
typename Service<ServiceT>::SharedPtr create_service(NodeT& node, const std::string& service_name, CallbackT&& callback,
                                                     const QoS& qos = ServicesQoS(),
                                                     CallbackGroup::SharedPtr group = nullptr) {
  auto& actual_node = node_interfaces::dereferenced(node);
  return create_service<ServiceT>(actual_node.get_node_base_interface(), actual_node.get_node_services_interface(),
                                  service_name, std::forward<CallbackT>(callback), qos, std::move(group));
}

}  // namespace rclcpp
