// SPDX-License-Identifier: Apache-2.0
// Introspection of an action: that of its three services.
#include <array>
#include <utility>

#include "action_client_impl.hpp"
#include "action_server_impl.hpp"
#include "rcl/error_handling.h"

namespace {

template <typename End>
using Parts = std::array<std::pair<End*, const rosidl_service_type_support_t*>, 3>;

// Configures all parts or none. If the first one fails, nothing has changed; if another fails, everything is off.
template <typename End, typename Configure>
rcl_ret_t configure_all(const Parts<End>& parts, rcl_service_introspection_state_t state, Configure configure) {
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
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  rcl_action_client_impl_t& impl = *action_client->impl;
  const Parts<rcl_client_t> parts{{{&impl.goal_client, type_support->goal_service_type_support},
                                   {&impl.cancel_client, type_support->cancel_service_type_support},
                                   {&impl.result_client, type_support->result_service_type_support}}};
  return configure_all(parts, introspection_state, [&](const auto& part, rcl_service_introspection_state_t state) {
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
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  rcl_action_server_impl_t& impl = *action_server->impl;
  const Parts<rcl_service_t> parts{{{&impl.goal_service, type_support->goal_service_type_support},
                                    {&impl.cancel_service, type_support->cancel_service_type_support},
                                    {&impl.result_service, type_support->result_service_type_support}}};
  return configure_all(parts, introspection_state, [&](const auto& part, rcl_service_introspection_state_t state) {
    return rcl_service_configure_service_introspection(part.first, node, clock, part.second, publisher_options, state);
  });
}
