// Clients for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/client.hpp"
#include "rclcpp/node_interfaces/node_services.hpp"

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

}  // namespace rclcpp
