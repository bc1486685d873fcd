// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/wait.h"

#include <algorithm>

#include "action_end.hpp"

namespace {

template <typename Entity>
bool contains(const Entity* const* entities, size_t count, const Entity& entity) {
  return std::find(entities, entities + count, &entity) != entities + count;
}

rcl_ret_t first_error(std::initializer_list<rcl_ret_t> results) {
  const auto error = std::find_if(results.begin(), results.end(), [](rcl_ret_t each) { return each != RCL_RET_OK; });
  return error == results.end() ? RCL_RET_OK : *error;
}

}  // namespace

rcl_ret_t rcl_action_server_wait_set_get_num_entities(const rcl_action_server_t* action_server,
                                                      size_t* num_subscriptions, size_t* num_guard_conditions,
                                                      size_t* num_timers, size_t* num_clients, size_t* num_services) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  *num_subscriptions = 0;
  *num_guard_conditions = 0;
  *num_timers = action_server->impl->expire_timer == &action_server->impl->own_timer ? 1 : 0;
  *num_clients = 0;
  *num_services = 3;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_client_wait_set_get_num_entities(const rcl_action_client_t* action_client,
                                                      size_t* num_subscriptions, size_t* num_guard_conditions,
                                                      size_t* num_timers, size_t* num_clients, size_t* num_services) {
  if (!rcl_action_client_is_valid(action_client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  *num_subscriptions = 2;
  *num_guard_conditions = 0;
  *num_timers = 0;
  *num_clients = 3;
  *num_services = 0;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_wait_set_add_action_server(rcl_wait_set_t* wait_set, const rcl_action_server_t* action_server,
                                                size_t* service_index) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  const rcl_action_server_impl_t& impl = *action_server->impl;
  return first_error(
      {rcl_wait_set_add_service(wait_set, &impl.goal, service_index),
       rcl_wait_set_add_service(wait_set, &impl.cancel, nullptr),
       rcl_wait_set_add_service(wait_set, &impl.result, nullptr),
       impl.expire_timer == &impl.own_timer ? rcl_wait_set_add_timer(wait_set, &impl.own_timer, nullptr) : RCL_RET_OK});
}

rcl_ret_t rcl_action_wait_set_add_action_client(rcl_wait_set_t* wait_set, const rcl_action_client_t* action_client,
                                                size_t* client_index, size_t* subscription_index) {
  if (!rcl_action_client_is_valid(action_client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  const rcl_action_client_impl_t& impl = *action_client->impl;
  return first_error({rcl_wait_set_add_client(wait_set, &impl.goal, client_index),
                      rcl_wait_set_add_client(wait_set, &impl.cancel, nullptr),
                      rcl_wait_set_add_client(wait_set, &impl.result, nullptr),
                      rcl_wait_set_add_subscription(wait_set, &impl.feedback, subscription_index),
                      rcl_wait_set_add_subscription(wait_set, &impl.status, nullptr)});
}

rcl_ret_t rcl_action_server_wait_set_get_entities_ready(const rcl_wait_set_t* wait_set,
                                                        const rcl_action_server_t* action_server,
                                                        bool* is_goal_request_ready, bool* is_cancel_request_ready,
                                                        bool* is_result_request_ready, bool* is_goal_expired) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  const rcl_action_server_impl_t& impl = *action_server->impl;
  const size_t services = wait_set->size_of_services;
  *is_goal_request_ready = contains(wait_set->services, services, impl.goal);
  *is_cancel_request_ready = contains(wait_set->services, services, impl.cancel);
  *is_result_request_ready = contains(wait_set->services, services, impl.result);
  *is_goal_expired = contains(wait_set->timers, wait_set->size_of_timers, *impl.expire_timer);
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_client_wait_set_get_entities_ready(const rcl_wait_set_t* wait_set,
                                                        const rcl_action_client_t* action_client,
                                                        bool* is_feedback_ready, bool* is_status_ready,
                                                        bool* is_goal_response_ready, bool* is_cancel_response_ready,
                                                        bool* is_result_response_ready) {
  if (!rcl_action_client_is_valid(action_client)) {
    return RCL_RET_ACTION_CLIENT_INVALID;
  }
  const rcl_action_client_impl_t& impl = *action_client->impl;
  const size_t subscriptions = wait_set->size_of_subscriptions;
  const size_t clients = wait_set->size_of_clients;
  *is_feedback_ready = contains(wait_set->subscriptions, subscriptions, impl.feedback);
  *is_status_ready = contains(wait_set->subscriptions, subscriptions, impl.status);
  *is_goal_response_ready = contains(wait_set->clients, clients, impl.goal);
  *is_cancel_response_ready = contains(wait_set->clients, clients, impl.cancel);
  *is_result_response_ready = contains(wait_set->clients, clients, impl.result);
  return RCL_RET_OK;
}
