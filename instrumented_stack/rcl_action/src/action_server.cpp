// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/action_server.h"

#include <memory>
#include <utility>

#include "action_end.hpp"
#include "rcl_action/default_qos.h"
#include "rmw/qos_profiles.h"

namespace {

using ActionServer = rcl_action_server_impl_s;

constexpr rcl_duration_value_t kResultTimeout = 10'000'000'000;

}  // namespace

namespace rcl_action {

rcl_ret_t init_all(rcl_action_server_impl_s& server, rcl_node_t* node, const rosidl_action_type_support_t& types) {
  const rcl_allocator_t& allocator = server.options.allocator;
  const auto init_service = [&](rcl_service_t& part, const auto* type, const char* name, const rmw_qos_profile_t& qos) {
    const rcl_service_options_t options{qos, allocator};
    return rcl_service_init(&part, node, type, name, &options);
  };
  const auto init_publisher = [&](rcl_publisher_t& part, const auto* type, const char* name,
                                  const rmw_qos_profile_t& qos) {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    options.qos = qos;
    return rcl_publisher_init(&part, node, type, name, &options);
  };
  if (const rcl_ret_t result = init_parts(server, types, init_service, init_publisher); result != RCL_RET_OK) {
    return result;
  }
  if (server.expire_timer != &server.own_timer) {
    return RCL_RET_OK;
  }
  // It runs only while there are ended goals.
  return rcl_timer_init2(&server.own_timer, server.clock, node->context, kResultTimeout, nullptr, allocator, false);
}

rcl_ret_t fini_all(rcl_action_server_impl_s& server, rcl_node_t* node) {
  for (const rcl_action_goal_handle_t* goal : std::exchange(server.goals, {})) {
    delete goal;
  }
  return last_error({rcl_timer_fini(&server.own_timer), rcl_service_fini(&server.goal, node),
                     rcl_service_fini(&server.cancel, node), rcl_service_fini(&server.result, node),
                     rcl_publisher_fini(&server.feedback, node), rcl_publisher_fini(&server.status, node)});
}

}  // namespace rcl_action

namespace {

rcl_ret_t take(const rcl_action_server_t* server, rcl_service_t ActionServer::*service, rmw_request_id_t* header,
               void* request) {
  if (!rcl_action_server_is_valid(server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  const rcl_ret_t result = rcl_take_request(&(server->impl->*service), header, request);
  return result == RCL_RET_SERVICE_TAKE_FAILED ? RCL_RET_ACTION_SERVER_TAKE_FAILED : result;
}

rcl_ret_t send(const rcl_action_server_t* server, rcl_service_t ActionServer::*service, rmw_request_id_t* header,
               void* response) {
  if (!rcl_action_server_is_valid(server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_send_response(&(server->impl->*service), header, response);
}

rcl_ret_t set_callback(const rcl_action_server_t* server, rcl_service_t ActionServer::*service,
                       rcl_event_callback_t callback, const void* user_data) {
  if (!rcl_action_server_is_valid(server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_service_set_on_new_request_callback(&(server->impl->*service), callback, user_data);
}

}  // namespace

rcl_action_server_t rcl_action_get_zero_initialized_server(void) {
  return {};
}

rcl_action_server_options_t rcl_action_server_get_default_options(void) {
  return {rmw_qos_profile_services_default,
          rmw_qos_profile_services_default,
          rmw_qos_profile_services_default,
          rmw_qos_profile_default,
          rcl_action_qos_profile_status_default,
          rcl_get_default_allocator(),
          {kResultTimeout}};
}

namespace {

// With a timer of its own if `expire_timer` is null.
rcl_ret_t init_server(rcl_action_server_t* action_server, rcl_node_t* node, rcl_clock_t* clock,
                      rcl_timer_t* expire_timer, const rosidl_action_type_support_t* type_support,
                      const char* action_name, const rcl_action_server_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_server, RCL_RET_ACTION_SERVER_INVALID);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (action_server->impl != nullptr) {
    RCL_SET_ERROR_MSG("the action server is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  auto impl = std::make_unique<ActionServer>();
  impl->options = *options;
  impl->action_name = action_name;
  impl->clock = clock;
  if (expire_timer != nullptr) {
    impl->expire_timer = expire_timer;
  }
  return rcl_action::init_end(action_server->impl, std::move(impl), node, *type_support);
}

}  // namespace

rcl_ret_t rcl_action_server_init(rcl_action_server_t* action_server, rcl_node_t* node, rcl_clock_t* clock,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_server_options_t* options) {
  return init_server(action_server, node, clock, nullptr, type_support, action_name, options);
}

rcl_ret_t rcl_action_server_init2(rcl_action_server_t* action_server, rcl_node_t* node, rcl_timer_t* expire_timer,
                                  const rosidl_action_type_support_t* type_support, const char* action_name,
                                  const rcl_action_server_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(expire_timer, RCL_RET_INVALID_ARGUMENT);
  rcl_clock_t* clock = nullptr;
  if (const rcl_ret_t result = rcl_timer_clock(expire_timer, &clock); result != RCL_RET_OK) {
    return result;
  }
  return init_server(action_server, node, clock, expire_timer, type_support, action_name, options);
}

rcl_ret_t rcl_action_server_fini(rcl_action_server_t* action_server, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_server, RCL_RET_ACTION_SERVER_INVALID);
  return rcl_action::fini_end(action_server->impl, node);
}

rcl_ret_t rcl_action_take_goal_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                       void* ros_goal_request) {
  return take(action_server, &ActionServer::goal, request_header, ros_goal_request);
}

rcl_ret_t rcl_action_send_goal_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                        void* ros_goal_response) {
  return send(action_server, &ActionServer::goal, response_header, ros_goal_response);
}

rcl_ret_t rcl_action_take_cancel_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_cancel_request) {
  return take(action_server, &ActionServer::cancel, request_header, ros_cancel_request);
}

rcl_ret_t rcl_action_send_cancel_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_cancel_response) {
  return send(action_server, &ActionServer::cancel, response_header, ros_cancel_response);
}

rcl_ret_t rcl_action_take_result_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_result_request) {
  return take(action_server, &ActionServer::result, request_header, ros_result_request);
}

rcl_ret_t rcl_action_send_result_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_result_response) {
  return send(action_server, &ActionServer::result, response_header, ros_result_response);
}

rcl_ret_t rcl_action_publish_feedback(const rcl_action_server_t* action_server, void* ros_feedback) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_publish(&action_server->impl->feedback, ros_feedback, nullptr);
}

rcl_ret_t rcl_action_publish_status(const rcl_action_server_t* action_server, const void* ros_status_array) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_publish(&action_server->impl->status, ros_status_array, nullptr);
}

rcl_ret_t rcl_action_server_set_goal_service_callback(const rcl_action_server_t* action_server,
                                                      rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &ActionServer::goal, callback, user_data);
}

rcl_ret_t rcl_action_server_set_cancel_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &ActionServer::cancel, callback, user_data);
}

rcl_ret_t rcl_action_server_set_result_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &ActionServer::result, callback, user_data);
}

const char* rcl_action_server_get_action_name(const rcl_action_server_t* action_server) {
  return rcl_action_server_is_valid(action_server) ? action_server->impl->action_name.c_str() : nullptr;
}

const rcl_action_server_options_t* rcl_action_server_get_options(const rcl_action_server_t* action_server) {
  return rcl_action_server_is_valid(action_server) ? &action_server->impl->options : nullptr;
}

bool rcl_action_server_is_valid(const rcl_action_server_t* action_server) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(action_server, "the action server is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(action_server->impl, "the action server is not initialized", return false);
  return true;
}
