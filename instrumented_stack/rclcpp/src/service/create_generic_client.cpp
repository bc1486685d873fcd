// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/create_generic_client.hpp"

namespace rclcpp {

GenericClient::SharedPtr create_generic_client(std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
                                               std::shared_ptr<node_interfaces::NodeGraphInterface> /*node_graph*/,
                                               std::shared_ptr<node_interfaces::NodeServicesInterface> node_services,
                                               const std::string& service_name, const std::string& service_type,
                                               const QoS& qos, CallbackGroup::SharedPtr group) {
  auto client = std::make_shared<GenericClient>(node_base.get(), service_name, service_type, qos);
  node_services->add_client(client, group);
  return client;
}

}  // namespace rclcpp
