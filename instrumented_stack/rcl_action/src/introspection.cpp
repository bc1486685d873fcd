// SPDX-License-Identifier: Apache-2.0
// Introspection of an action: that of its three services.
#include <array>
#include <utility>

#include "action_end.hpp"

namespace {

// Configures the three services or none. If the first one fails, nothing has changed; if another fails, all are off.
template <typename End, typename Configure>
rcl_ret_t configure_all(End& end, const rosidl_action_type_support_t* type_support,
                        rcl_service_introspection_state_t state, Configure configure) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  const auto parts = std::array{std::pair(&end.goal, type_support->goal_service_type_support),
                                std::pair(&end.cancel, type_support->cancel_service_type_support),
                                std::pair(&end.result, type_support->result_service_type_support)};
  for (const auto& part : parts) {
    const rcl_ret_t result = configure(part, state);
    if (result == RCL_RET_OK) {
      continue;
    }
    if (&part != &parts.front()) {
      const rcl_error_string_t reason = rcl_get_error_string();
      for (const auto& each : parts) {
        (void)configure(each, RCL_SERVICE_INTROSPECTION_OFF);
      }
      rcl_reset_error();
      RCL_SET_ERROR_MSG(reason.str);
    }
    return result;
  }
  return RCL_RET_OK;
}

}  // namespace

rcl_ret_t rcl_action_client_configure_action_introspection(rcl_action_client_t* action_client, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state) {
  if (!rcl_action_client_is_valid(action_client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  return configure_all(*action_client->impl, type_support, introspection_state, [&](const auto& part, auto state) {
    return rcl_client_configure_service_introspection(part.first, node, clock, part.second, publisher_options, state);
  });
}

rcl_ret_t rcl_action_server_configure_action_introspection(rcl_action_server_t* action_server, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return configure_all(*action_server->impl, type_support, introspection_state, [&](const auto& part, auto state) {
    return rcl_service_configure_service_introspection(part.first, node, clock, part.second, publisher_options, state);
  });
}
