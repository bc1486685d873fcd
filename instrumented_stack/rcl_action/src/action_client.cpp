// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/action_client.h"

#include <memory>
#include <utility>

#include "action_end.hpp"
#include "rcl/graph.h"
#include "rcl_action/default_qos.h"
#include "rmw/qos_profiles.h"

namespace rcl_action {

rcl_ret_t init_all(rcl_action_client_impl_s& client, rcl_node_t* node, const rosidl_action_type_support_t& types) {
  const auto init_client = [&](rcl_client_t& part, const auto* type, const char* name, const rmw_qos_profile_t& qos) {
    const rcl_client_options_t options{qos, client.options.allocator};
    return rcl_client_init(&part, node, type, name, &options);
  };
  const auto init_subscription = [&](rcl_subscription_t& part, const auto* type, const char* name,
                                     const rmw_qos_profile_t& qos) {
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    options.qos = qos;
    return rcl_subscription_init(&part, node, type, name, &options);
  };
  return init_parts(client, types, init_client, init_subscription);
}

rcl_ret_t fini_all(rcl_action_client_impl_s& client, rcl_node_t* node) {
  return last_error({rcl_client_fini(&client.goal, node), rcl_client_fini(&client.cancel, node),
                     rcl_client_fini(&client.result, node), rcl_subscription_fini(&client.feedback, node),
                     rcl_subscription_fini(&client.status, node)});
}

}  // namespace rcl_action

namespace {

using ActionClient = rcl_action_client_impl_s;

rcl_ret_t send(const rcl_action_client_t* client, rcl_client_t ActionClient::*part, const void* request,
               int64_t* sequence_number) {
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  return rcl_send_request(&(client->impl->*part), request, sequence_number);
}

rcl_ret_t take(const rcl_action_client_t* client, rcl_client_t ActionClient::*part, rmw_request_id_t* header,
               void* response) {
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  const rcl_ret_t result = rcl_take_response(&(client->impl->*part), header, response);
  return result == RCL_RET_CLIENT_TAKE_FAILED ? RCL_RET_ACTION_CLIENT_TAKE_FAILED : result;
}

rcl_ret_t take(const rcl_action_client_t* client, rcl_subscription_t ActionClient::*part, void* message) {
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  rmw_message_info_t info = rmw_get_zero_initialized_message_info();
  const rcl_ret_t result = rcl_take(&(client->impl->*part), message, &info, nullptr);
  return result == RCL_RET_SUBSCRIPTION_TAKE_FAILED ? RCL_RET_ACTION_CLIENT_TAKE_FAILED : result;
}

rcl_ret_t set_callback(const rcl_action_client_t* client, rcl_client_t ActionClient::*part,
                       rcl_event_callback_t callback, const void* user_data) {
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  return rcl_client_set_on_new_response_callback(&(client->impl->*part), callback, user_data);
}

rcl_ret_t set_callback(const rcl_action_client_t* client, rcl_subscription_t ActionClient::*part,
                       rcl_event_callback_t callback, const void* user_data) {
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  return rcl_subscription_set_on_new_message_callback(&(client->impl->*part), callback, user_data);
}

}  // namespace

rcl_action_client_t rcl_action_get_zero_initialized_client(void) {
  return {};
}

rcl_action_client_options_t rcl_action_client_get_default_options(void) {
  return {rmw_qos_profile_services_default, rmw_qos_profile_services_default,      rmw_qos_profile_services_default,
          rmw_qos_profile_default,          rcl_action_qos_profile_status_default, rcl_get_default_allocator()};
}

rcl_ret_t rcl_action_client_init(rcl_action_client_t* action_client, rcl_node_t* node,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_client_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_client, RCL_RET_ACTION_CLIENT_INVALID);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (action_client->impl != nullptr) {
    RCL_SET_ERROR_MSG("the action client is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  auto impl = std::make_unique<ActionClient>();
  impl->options = *options;
  impl->action_name = action_name;
  return rcl_action::init_end(action_client->impl, std::move(impl), node, *type_support);
}

rcl_ret_t rcl_action_client_fini(rcl_action_client_t* action_client, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_client, RCL_RET_ACTION_CLIENT_INVALID);
  return rcl_action::fini_end(action_client->impl, node);
}

rcl_ret_t rcl_action_server_is_available(const rcl_node_t* node, const rcl_action_client_t* client,
                                         bool* is_available) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(is_available, RCL_RET_INVALID_ARGUMENT);
  if (!rcl_action_client_is_valid(client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  const rcl_action_client_impl_t& impl = *client->impl;
  *is_available = false;
  for (const rcl_client_t* part : {&impl.goal, &impl.cancel, &impl.result}) {
    bool is_there = false;
    if (const rcl_ret_t result = rcl_service_server_is_available(node, part, &is_there);
        result != RCL_RET_OK || !is_there) {
      return result;
    }
  }
  for (const rcl_subscription_t* part : {&impl.feedback, &impl.status}) {
    size_t publishers = 0;
    if (const rcl_ret_t result = rcl_subscription_get_publisher_count(part, &publishers);
        result != RCL_RET_OK || publishers == 0) {
      return result;
    }
  }
  *is_available = true;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_send_goal_request(const rcl_action_client_t* action_client, const void* ros_goal_request,
                                       int64_t* sequence_number) {
  return send(action_client, &ActionClient::goal, ros_goal_request, sequence_number);
}

rcl_ret_t rcl_action_send_cancel_request(const rcl_action_client_t* action_client, const void* ros_cancel_request,
                                         int64_t* sequence_number) {
  return send(action_client, &ActionClient::cancel, ros_cancel_request, sequence_number);
}

rcl_ret_t rcl_action_send_result_request(const rcl_action_client_t* action_client, const void* ros_result_request,
                                         int64_t* sequence_number) {
  return send(action_client, &ActionClient::result, ros_result_request, sequence_number);
}

rcl_ret_t rcl_action_take_goal_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                        void* ros_goal_response) {
  return take(action_client, &ActionClient::goal, response_header, ros_goal_response);
}

rcl_ret_t rcl_action_take_cancel_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                          void* ros_cancel_response) {
  return take(action_client, &ActionClient::cancel, response_header, ros_cancel_response);
}

rcl_ret_t rcl_action_take_result_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                          void* ros_result_response) {
  return take(action_client, &ActionClient::result, response_header, ros_result_response);
}

rcl_ret_t rcl_action_take_feedback(const rcl_action_client_t* action_client, void* ros_feedback) {
  return take(action_client, &ActionClient::feedback, ros_feedback);
}

rcl_ret_t rcl_action_take_status(const rcl_action_client_t* action_client, void* ros_status_array) {
  return take(action_client, &ActionClient::status, ros_status_array);
}

rcl_ret_t rcl_action_client_set_goal_client_callback(const rcl_action_client_t* action_client,
                                                     rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_client, &ActionClient::goal, callback, user_data);
}

rcl_ret_t rcl_action_client_set_cancel_client_callback(const rcl_action_client_t* action_client,
                                                       rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_client, &ActionClient::cancel, callback, user_data);
}

rcl_ret_t rcl_action_client_set_result_client_callback(const rcl_action_client_t* action_client,
                                                       rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_client, &ActionClient::result, callback, user_data);
}

rcl_ret_t rcl_action_client_set_feedback_subscription_callback(const rcl_action_client_t* action_client,
                                                               rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_client, &ActionClient::feedback, callback, user_data);
}

rcl_ret_t rcl_action_client_set_status_subscription_callback(const rcl_action_client_t* action_client,
                                                             rcl_event_callback_t callback, const void* user_data) {
  return set_callback(action_client, &ActionClient::status, callback, user_data);
}

const char* rcl_action_client_get_action_name(const rcl_action_client_t* action_client) {
  return rcl_action_client_is_valid(action_client) ? action_client->impl->action_name.c_str() : nullptr;
}

const rcl_action_client_options_t* rcl_action_client_get_options(const rcl_action_client_t* action_client) {
  return rcl_action_client_is_valid(action_client) ? &action_client->impl->options : nullptr;
}

bool rcl_action_client_is_valid(const rcl_action_client_t* action_client) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(action_client, "the action client is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(action_client->impl, "the action client is not initialized", return false);
  return true;
}
