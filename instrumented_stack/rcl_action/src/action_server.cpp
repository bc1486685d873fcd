// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/action_server.h"

#include <cstring>

#include "action_server_impl.hpp"
#include "init_named.hpp"
#include "rcl/error_handling.h"
#include "rcl/node_type_cache.h"
#include "rcl_action/default_qos.h"
#include "rcl_action/names.h"
#include "rmw/qos_profiles.h"

namespace {

constexpr rcl_duration_value_t kResultTimeout = 10'000'000'000;

rcl_ret_t init_service(rcl_service_t& service, rcl_action::MakeName make_name, const rcl_action_server_impl_t& impl,
                       const rcl_node_t* node, const rosidl_service_type_support_t* type_support,
                       const rmw_qos_profile_t& qos) {
  return rcl_action::init_named(make_name, impl.action_name.c_str(), impl.options.allocator, [&](const char* name) {
    const rcl_service_options_t options{qos, impl.options.allocator};
    return rcl_service_init(&service, node, type_support, name, &options);
  });
}

rcl_ret_t init_publisher(rcl_publisher_t& publisher, rcl_action::MakeName make_name,
                         const rcl_action_server_impl_t& impl, const rcl_node_t* node,
                         const rosidl_message_type_support_t* type_support, const rmw_qos_profile_t& qos) {
  return rcl_action::init_named(make_name, impl.action_name.c_str(), impl.options.allocator, [&](const char* name) {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    options.qos = qos;
    return rcl_publisher_init(&publisher, node, type_support, name, &options);
  });
}

rcl_ret_t init_all(rcl_action_server_impl_t& impl, rcl_node_t* node, const rosidl_action_type_support_t& types) {
  const rcl_action_server_options_t& options = impl.options;
  rcl_ret_t result = init_service(impl.goal_service, rcl_action_get_goal_service_name, impl, node,
                                  types.goal_service_type_support, options.goal_service_qos);
  if (result == RCL_RET_OK) {
    result = init_service(impl.cancel_service, rcl_action_get_cancel_service_name, impl, node,
                          types.cancel_service_type_support, options.cancel_service_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_service(impl.result_service, rcl_action_get_result_service_name, impl, node,
                          types.result_service_type_support, options.result_service_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_publisher(impl.feedback_publisher, rcl_action_get_feedback_topic_name, impl, node,
                            types.feedback_message_type_support, options.feedback_topic_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_publisher(impl.status_publisher, rcl_action_get_status_topic_name, impl, node,
                            types.status_message_type_support, options.status_topic_qos);
  }
  if (result == RCL_RET_OK) {
    // It runs only while there are ended goals.
    result = rcl_timer_init2(&impl.expire_timer, impl.clock, node->context, kResultTimeout, nullptr, options.allocator,
                             false);
  }
  return result;
}

rcl_ret_t fini_all(rcl_action_server_impl_t& impl, rcl_node_t* node) {
  rcl_ret_t result = rcl_timer_fini(&impl.expire_timer);
  for (const rcl_ret_t each :
       {rcl_service_fini(&impl.goal_service, node), rcl_service_fini(&impl.cancel_service, node),
        rcl_service_fini(&impl.result_service, node), rcl_publisher_fini(&impl.feedback_publisher, node),
        rcl_publisher_fini(&impl.status_publisher, node)}) {
    if (each != RCL_RET_OK) {
      result = each;
    }
  }
  return result;
}

rcl_ret_t take(const rcl_action_server_t* server, rcl_service_t rcl_action_server_impl_s::*service,
               rmw_request_id_t* header, void* request) {
  if (!rcl_action_server_is_valid(server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  const rcl_ret_t result = rcl_take_request(&(server->impl->*service), header, request);
  return result == RCL_RET_SERVICE_TAKE_FAILED ? RCL_RET_ACTION_SERVER_TAKE_FAILED : result;
}

rcl_ret_t send(const rcl_action_server_t* server, rcl_service_t rcl_action_server_impl_s::*service,
               rmw_request_id_t* header, void* response) {
  if (!rcl_action_server_is_valid(server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_send_response(&(server->impl->*service), header, response);
}

rcl_ret_t set_callback(const rcl_action_server_t* server, rcl_service_t rcl_action_server_impl_s::*service,
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

rcl_ret_t rcl_action_server_init(rcl_action_server_t* action_server, rcl_node_t* node, rcl_clock_t* clock,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_server_options_t* options) {
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
  auto* impl = new rcl_action_server_impl_s;
  impl->options = *options;
  impl->action_name = action_name;
  impl->clock = clock;
  if (const rcl_ret_t result = init_all(*impl, node, *type_support); result != RCL_RET_OK) {
    // The caller gets the first error.
    const rcl_error_string_t reason = rcl_get_error_string();
    (void)fini_all(*impl, node);
    rcl_reset_error();
    RCL_SET_ERROR_MSG(reason.str);
    delete impl;
    return result;
  }
  impl->type = type_support->description;
  (void)rcl_node_type_cache_register_type(node, impl->type);
  action_server->impl = impl;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_server_fini(rcl_action_server_t* action_server, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_server, RCL_RET_ACTION_SERVER_INVALID);
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (action_server->impl == nullptr) {
    return RCL_RET_OK;
  }
  (void)rcl_node_type_cache_unregister_type(node, action_server->impl->type);
  const rcl_ret_t result = fini_all(*action_server->impl, node);
  delete action_server->impl;
  action_server->impl = nullptr;
  return result;
}

rcl_ret_t rcl_action_take_goal_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                       void* ros_goal_request) {
  return take(action_server, &rcl_action_server_impl_s::goal_service, request_header, ros_goal_request);
}

rcl_ret_t rcl_action_send_goal_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                        void* ros_goal_response) {
  return send(action_server, &rcl_action_server_impl_s::goal_service, response_header, ros_goal_response);
}

rcl_ret_t rcl_action_take_cancel_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_cancel_request) {
  return take(action_server, &rcl_action_server_impl_s::cancel_service, request_header, ros_cancel_request);
}

rcl_ret_t rcl_action_send_cancel_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_cancel_response) {
  return send(action_server, &rcl_action_server_impl_s::cancel_service, response_header, ros_cancel_response);
}

rcl_ret_t rcl_action_take_result_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_result_request) {
  return take(action_server, &rcl_action_server_impl_s::result_service, request_header, ros_result_request);
}

rcl_ret_t rcl_action_send_result_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_result_response) {
  return send(action_server, &rcl_action_server_impl_s::result_service, response_header, ros_result_response);
}

rcl_ret_t rcl_action_publish_feedback(const rcl_action_server_t* action_server, void* ros_feedback) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_publish(&action_server->impl->feedback_publisher, ros_feedback, nullptr);
}

rcl_ret_t rcl_action_publish_status(const rcl_action_server_t* action_server, const void* ros_status_array) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  return rcl_publish(&action_server->impl->status_publisher, ros_status_array, nullptr);
}

rcl_ret_t rcl_action_server_set_goal_service_callback(const rcl_action_server_t* action_server,
                                                      rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &rcl_action_server_impl_s::goal_service, callback, user_data);
}

rcl_ret_t rcl_action_server_set_cancel_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &rcl_action_server_impl_s::cancel_service, callback, user_data);
}

rcl_ret_t rcl_action_server_set_result_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_server, &rcl_action_server_impl_s::result_service, callback, user_data);
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
