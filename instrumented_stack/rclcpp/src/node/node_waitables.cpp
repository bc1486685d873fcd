// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_waitables.hpp"

#include <stdexcept>

namespace rclcpp::node_interfaces {

void NodeWaitables::add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create waitable, group not in node.");
  }
  (group ? group : node_base_->get_default_callback_group())->add_waitable(waitable);
}

void NodeWaitables::remove_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) noexcept {
  if (group && !node_base_->callback_group_in_node(group)) {
    return;
  }
  (group ? group : node_base_->get_default_callback_group())->remove_waitable(waitable);
}

}  // namespace rclcpp::node_interfaces
