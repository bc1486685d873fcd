// Introspection of an action is that of its three services.
#include "action_client_impl.hpp"
#include "action_server_impl.hpp"
#include "rcl/error_handling.h"

rcl_ret_t rcl_action_client_configure_action_introspection(rcl_action_client_t* action_client, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state) {
  if (!rcl_action_client_is_valid(action_client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  const auto configure = [&](rcl_client_t& client, const rosidl_service_type_support_t* type) {
    return rcl_client_configure_service_introspection(&client, node, clock, type, publisher_options,
                                                      introspection_state);
  };
  rcl_action_client_impl_t& impl = *action_client->impl;
  rcl_ret_t result = configure(impl.goal_client, type_support->goal_service_type_support);
  if (result == RCL_RET_OK) {
    result = configure(impl.cancel_client, type_support->cancel_service_type_support);
  }
  if (result == RCL_RET_OK) {
    result = configure(impl.result_client, type_support->result_service_type_support);
  }
  return result;
}

rcl_ret_t rcl_action_server_configure_action_introspection(rcl_action_server_t* action_server, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  const auto configure = [&](rcl_service_t& service, const rosidl_service_type_support_t* type) {
    return rcl_service_configure_service_introspection(&service, node, clock, type, publisher_options,
                                                       introspection_state);
  };
  rcl_action_server_impl_t& impl = *action_server->impl;
  rcl_ret_t result = configure(impl.goal_service, type_support->goal_service_type_support);
  if (result == RCL_RET_OK) {
    result = configure(impl.cancel_service, type_support->cancel_service_type_support);
  }
  if (result == RCL_RET_OK) {
    result = configure(impl.result_service, type_support->result_service_type_support);
  }
  return result;
}
