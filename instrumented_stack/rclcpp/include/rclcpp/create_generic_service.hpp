// SPDX-License-Identifier: Apache-2.0
// Creates services whose type is given by name, for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/generic_service.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp {

// `service_type` looks like "std_srvs/srv/SetBool". Throws what the constructor of GenericService throws.
template <typename CallbackT>
GenericService::SharedPtr create_generic_service(std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
                                                 std::shared_ptr<node_interfaces::NodeServicesInterface> node_services,
                                                 const std::string& service_name, const std::string& service_type,
                                                 CallbackT&& callback, const QoS& qos = ServicesQoS(),
                                                 CallbackGroup::SharedPtr group = nullptr) {
  auto service = std::make_shared<GenericService>(node_base.get(), service_name, service_type,
                                                  GenericServiceCallback(std::forward<CallbackT>(callback)), qos);
  node_services->add_service(service, group);
  return service;
}

}  // namespace rclcpp
