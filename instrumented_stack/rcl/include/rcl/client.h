// SPDX-License-Identifier: Apache-2.0
// The end of a service that sends requests and takes responses.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "rcl/event_callback.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_client_impl_s rcl_client_impl_t;

typedef struct rcl_client_s {
  rcl_client_impl_t* impl;
} rcl_client_t;

typedef struct rcl_client_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
} rcl_client_options_t;

rcl_client_t rcl_get_zero_initialized_client(void);
rcl_client_options_t rcl_client_get_default_options(void);

// Creates the client of the expanded and remapped service. Fires rcl_client_init with that name.
// RCL_RET_SERVICE_NAME_INVALID, RCL_RET_NODE_INVALID, RCL_RET_ALREADY_INIT.
rcl_ret_t rcl_client_init(rcl_client_t* client, const rcl_node_t* node,
                          const rosidl_service_type_support_t* type_support, const char* service_name,
                          const rcl_client_options_t* options);
rcl_ret_t rcl_client_fini(rcl_client_t* client, rcl_node_t* node);

// `sequence_number` gets the number that the response will carry.
rcl_ret_t rcl_send_request(const rcl_client_t* client, const void* ros_request, int64_t* sequence_number);

// Takes the next response, RCL_RET_CLIENT_TAKE_FAILED when there is none or it was for another client.
rcl_ret_t rcl_take_response_with_info(const rcl_client_t* client, rmw_service_info_t* request_header,
                                      void* ros_response);
rcl_ret_t rcl_take_response(const rcl_client_t* client, rmw_request_id_t* request_header, void* ros_response);

const char* rcl_client_get_service_name(const rcl_client_t* client);
const rcl_client_options_t* rcl_client_get_options(const rcl_client_t* client);
rmw_client_t* rcl_client_get_rmw_handle(const rcl_client_t* client);
const rmw_qos_profile_t* rcl_client_request_publisher_get_actual_qos(const rcl_client_t* client);
const rmw_qos_profile_t* rcl_client_response_subscription_get_actual_qos(const rcl_client_t* client);
bool rcl_client_is_valid(const rcl_client_t* client);

// `callback` is told of every response that arrives, and at once of those that wait to be taken. Null ends the calls:
// none is going on any more when this returns. Not to be called from the callback.
rcl_ret_t rcl_client_set_on_new_response_callback(const rcl_client_t* client, rcl_event_callback_t callback,
                                                  const void* user_data);

// Lets the client publish what happens to its calls on the service's name and RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX,
// changes what it publishes of them, or ends that: requests that were sent and responses that were taken.
// `type_support` is that of the client. The publisher options count when it is off so far. The clock gives the events
// their times and must live until it is off or the client is finalized. Thread safe. RCL_RET_CLIENT_INVALID,
// RCL_RET_INVALID_ARGUMENT, and what rcl_publisher_init() returns.
rcl_ret_t rcl_client_configure_service_introspection(rcl_client_t* client, rcl_node_t* node, rcl_clock_t* clock,
                                                     const rosidl_service_type_support_t* type_support,
                                                     const rcl_publisher_options_t publisher_options,
                                                     rcl_service_introspection_state_t introspection_state);

#ifdef __cplusplus
}
#endif
