// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_timers.hpp"

#include <tracetools/tracetools.h>

#include <stdexcept>

namespace rclcpp::node_interfaces {

void NodeTimers::add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) {
  if (group && !node_base_->callback_group_in_node(group)) {
    throw std::runtime_error("Cannot create timer, group not in node.");
  }
  (group ? group : node_base_->get_default_callback_group())->add_timer(timer);
  TRACETOOLS_TRACEPOINT(rclcpp_timer_link_node, static_cast<const void*>(timer->get_timer_handle().get()),
                        static_cast<const void*>(node_base_->get_rcl_node_handle()));
}

}  // namespace rclcpp::node_interfaces
