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

// Creates the client of the expanded and remapped service. Fires rcl_client_init with that name. Returns
// RCL_RET_SERVICE_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_client_init(rcl_client_t* client, const rcl_node_t* node,
                          const rosidl_service_type_support_t* type_support, const char* service_name,
                          const rcl_client_options_t* options);
rcl_ret_t rcl_client_fini(rcl_client_t* client, rcl_node_t* node);

// `sequence_number` gets the number that the response will carry.
rcl_ret_t rcl_send_request(const rcl_client_t* client, const void* ros_request, int64_t* sequence_number);

// Takes the next response. Returns RCL_RET_CLIENT_TAKE_FAILED if there is none or it was for another client.
rcl_ret_t rcl_take_response_with_info(const rcl_client_t* client, rmw_service_info_t* request_header,
                                      void* ros_response);
rcl_ret_t rcl_take_response(const rcl_client_t* client, rmw_request_id_t* request_header, void* ros_response);

const char* rcl_client_get_service_name(const rcl_client_t* client);
const rcl_client_options_t* rcl_client_get_options(const rcl_client_t* client);
rmw_client_t* rcl_client_get_rmw_handle(const rcl_client_t* client);
const rmw_qos_profile_t* rcl_client_request_publisher_get_actual_qos(const rcl_client_t* client);
const rmw_qos_profile_t* rcl_client_response_subscription_get_actual_qos(const rcl_client_t* client);
bool rcl_client_is_valid(const rcl_client_t* client);

// `callback` is called for every response that arrives, and at once for those that wait to be taken. Null ends the
// calls: none is running any more when this returns. Must not be called from the callback.
rcl_ret_t rcl_client_set_on_new_response_callback(const rcl_client_t* client, rcl_event_callback_t callback,
                                                  const void* user_data);

// Turns on, changes or turns off the introspection of this client: it publishes the requests sent and the responses
// taken on a topic named after the service plus RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX. `type_support` is that of the
// client. The publisher options only apply when it is turned on. The clock gives the events their times; it must live
// until introspection is off or the client is finalized. Thread safe. Returns RCL_RET_CLIENT_INVALID,
// RCL_RET_INVALID_ARGUMENT, or an error of rcl_publisher_init().
rcl_ret_t rcl_client_configure_service_introspection(rcl_client_t* client, rcl_node_t* node, rcl_clock_t* clock,
                                                     const rosidl_service_type_support_t* type_support,
                                                     const rcl_publisher_options_t publisher_options,
                                                     rcl_service_introspection_state_t introspection_state);

#ifdef __cplusplus
}
#endif
