// SPDX-License-Identifier: Apache-2.0
// Introspection of clients and servers of actions.
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp_action/client.hpp"
#include "rclcpp_action/server.hpp"

namespace rclcpp_action {

namespace {

rcl_publisher_options_t publisher_options(const rclcpp::QoS& qos) {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos.get_rmw_qos_profile();
  return options;
}

rcl_clock_t* handle_of(const rclcpp::Clock::SharedPtr& clock) {
  return clock ? clock->get_clock_handle() : nullptr;
}

}  // namespace

void ClientBase::configure_introspection(rclcpp::Clock::SharedPtr clock, const rclcpp::QoS& qos_service_event_pub,
                                         rcl_service_introspection_state_t introspection_state) {
  const std::lock_guard lock(mutex_);
  rclcpp::detail::require_ok(rcl_action_client_configure_action_introspection(
                                 &client_, node_base_->get_rcl_node_handle(), handle_of(clock), introspected_type_,
                                 publisher_options(qos_service_event_pub), introspection_state),
                             "failed to configure action client introspection");
  introspection_clock_ = std::move(clock);
}

void ServerBase::configure_introspection(rclcpp::Clock::SharedPtr clock, const rclcpp::QoS& qos_service_event_pub,
                                         rcl_service_introspection_state_t introspection_state) {
  const std::lock_guard lock(mutex_);
  rclcpp::detail::require_ok(rcl_action_server_configure_action_introspection(
                                 &server_, node_base_->get_rcl_node_handle(), handle_of(clock), introspected_type_,
                                 publisher_options(qos_service_event_pub), introspection_state),
                             "failed to configure action server introspection");
  introspection_clock_ = std::move(clock);
}

}  // namespace rclcpp_action
