// SPDX-License-Identifier: Apache-2.0
// The ends of an action, client and server, and what they do alike. Each has an end of three services and of two
// topics, named after the action.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rcl/client.h"
#include "rcl/error_handling.h"
#include "rcl/node_type_cache.h"
#include "rcl/publisher.h"
#include "rcl/service.h"
#include "rcl/subscription.h"
#include "rcl_action/action_client.h"
#include "rcl_action/action_server.h"
#include "rcl_action/names.h"
#include "rosidl_runtime_c/type_description.h"

namespace rcl_action {

// The parts are clients and subscriptions, or services and publishers.
template <typename Options, typename ServiceEnd, typename TopicEnd>
struct ActionEnd {
  Options options{};
  std::string action_name{};
  const rosidl_type_description_t* type = nullptr;
  ServiceEnd goal{};
  ServiceEnd cancel{};
  ServiceEnd result{};
  TopicEnd feedback{};
  TopicEnd status{};
};

}  // namespace rcl_action

struct rcl_action_client_impl_s : rcl_action::ActionEnd<rcl_action_client_options_t, rcl_client_t, rcl_subscription_t> {
};

struct rcl_action_server_impl_s : rcl_action::ActionEnd<rcl_action_server_options_t, rcl_service_t, rcl_publisher_t> {
  rcl_clock_t* clock = nullptr;
  rcl_timer_t own_timer = rcl_get_zero_initialized_timer();
  rcl_timer_t* expire_timer = &own_timer;          // the other one is the caller's
  std::vector<rcl_action_goal_handle_t*> goals{};  // deleted when they expire, at the latest with the server
};

namespace rcl_action {

// Initialise all parts, until an error. End all parts, also after an error, and return the last one.
rcl_ret_t init_all(rcl_action_client_impl_s& client, rcl_node_t* node, const rosidl_action_type_support_t& types);
rcl_ret_t init_all(rcl_action_server_impl_s& server, rcl_node_t* node, const rosidl_action_type_support_t& types);
rcl_ret_t fini_all(rcl_action_client_impl_s& client, rcl_node_t* node);
rcl_ret_t fini_all(rcl_action_server_impl_s& server, rcl_node_t* node);

// The parts that both ends have. `init_service` and `init_topic` initialise one each: with its type, name and QoS.
template <typename End, typename InitService, typename InitTopic>
rcl_ret_t init_parts(End& end, const rosidl_action_type_support_t& types, InitService init_service,
                     InitTopic init_topic) {
  const auto& options = end.options;
  const auto init_named = [&](auto make_name, auto init, auto& part, const auto* type, const rmw_qos_profile_t& qos) {
    char* name = nullptr;
    if (const rcl_ret_t made = make_name(end.action_name.c_str(), options.allocator, &name); made != RCL_RET_OK) {
      return made;
    }
    const rcl_ret_t result = init(part, type, name, qos);
    options.allocator.deallocate(name, options.allocator.state);
    const bool name_is_wrong = result == RCL_RET_SERVICE_NAME_INVALID || result == RCL_RET_TOPIC_NAME_INVALID;
    return name_is_wrong ? RCL_RET_ACTION_NAME_INVALID : result;
  };
  rcl_ret_t result = init_named(rcl_action_get_goal_service_name, init_service, end.goal,
                                types.goal_service_type_support, options.goal_service_qos);
  if (result == RCL_RET_OK) {
    result = init_named(rcl_action_get_cancel_service_name, init_service, end.cancel, types.cancel_service_type_support,
                        options.cancel_service_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_named(rcl_action_get_result_service_name, init_service, end.result, types.result_service_type_support,
                        options.result_service_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_named(rcl_action_get_feedback_topic_name, init_topic, end.feedback,
                        types.feedback_message_type_support, options.feedback_topic_qos);
  }
  if (result == RCL_RET_OK) {
    result = init_named(rcl_action_get_status_topic_name, init_topic, end.status, types.status_message_type_support,
                        options.status_topic_qos);
  }
  return result;
}

// Gives `place` the end with its parts. On failure nothing is left, and the caller gets the first error.
template <typename End>
rcl_ret_t init_end(End*& place, std::unique_ptr<End> end, rcl_node_t* node, const rosidl_action_type_support_t& types) {
  if (const rcl_ret_t result = init_all(*end, node, types); result != RCL_RET_OK) {
    const rcl_error_string_t reason = rcl_get_error_string();
    (void)fini_all(*end, node);
    rcl_reset_error();
    RCL_SET_ERROR_MSG(reason.str);
    return result;
  }
  end->type = types.description;
  (void)rcl_node_type_cache_register_type(node, end->type);
  place = end.release();
  return RCL_RET_OK;
}

template <typename End>
rcl_ret_t fini_end(End*& place, rcl_node_t* node) {
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (place == nullptr) {
    return RCL_RET_OK;
  }
  const std::unique_ptr<End> end(std::exchange(place, nullptr));
  (void)rcl_node_type_cache_unregister_type(node, end->type);
  return fini_all(*end, node);
}

inline rcl_ret_t last_error(std::initializer_list<rcl_ret_t> results) {
  rcl_ret_t last = RCL_RET_OK;
  for (const rcl_ret_t result : results) {
    last = result == RCL_RET_OK ? last : result;
  }
  return last;
}

}  // namespace rcl_action
