// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_services.hpp"

#include <stdexcept>

namespace rclcpp::node_interfaces {

void NodeServices::add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create service, group not in node.");
  }
  (group ? group : node_base_->get_default_callback_group())->add_service(service);
}

void NodeServices::add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create client, group not in node.");
  }
  (group ? group : node_base_->get_default_callback_group())->add_client(client);
}

}  // namespace rclcpp::node_interfaces
