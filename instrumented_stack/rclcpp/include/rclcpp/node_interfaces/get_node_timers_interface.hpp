// node_interfaces::get_node_timers_interface(node), for anything that has that interface or points to something that
// has.
#pragma once

#include <memory>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_timers.hpp"

namespace rclcpp::node_interfaces {

template <typename NodeT>
std::shared_ptr<NodeTimersInterface> get_node_timers_interface(NodeT&& node) {
  return dereferenced(node).get_node_timers_interface();
}
inline std::shared_ptr<NodeTimersInterface> get_node_timers_interface(
    const std::shared_ptr<NodeTimersInterface>& interface) {
  return interface;
}
inline std::shared_ptr<NodeTimersInterface> get_node_timers_interface(std::shared_ptr<NodeTimersInterface>& interface) {
  return interface;
}
inline std::shared_ptr<NodeTimersInterface> get_node_timers_interface(
    std::shared_ptr<NodeTimersInterface>&& interface) {
  return interface;
}

}  // namespace rclcpp::node_interfaces
