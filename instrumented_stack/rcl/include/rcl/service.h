// SPDX-License-Identifier: Apache-2.0
// The end of a service that takes requests and sends responses.
#pragma once

#include <stdbool.h>

#include "rcl/event_callback.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_service_impl_s rcl_service_impl_t;

typedef struct rcl_service_s {
  rcl_service_impl_t* impl;
} rcl_service_t;

typedef struct rcl_service_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
} rcl_service_options_t;

rcl_service_t rcl_get_zero_initialized_service(void);
rcl_service_options_t rcl_service_get_default_options(void);

// Creates the service under the expanded and remapped name. Fires rcl_service_init with that name. Returns
// RCL_RET_SERVICE_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_service_init(rcl_service_t* service, const rcl_node_t* node,
                           const rosidl_service_type_support_t* type_support, const char* service_name,
                           const rcl_service_options_t* options);
rcl_ret_t rcl_service_fini(rcl_service_t* service, rcl_node_t* node);

// Takes the next request. Returns RCL_RET_SERVICE_TAKE_FAILED if there is none.
rcl_ret_t rcl_take_request_with_info(const rcl_service_t* service, rmw_service_info_t* request_header,
                                     void* ros_request);
rcl_ret_t rcl_take_request(const rcl_service_t* service, rmw_request_id_t* request_header, void* ros_request);

// Pass `response_header` as it came with the request. Returns RCL_RET_TIMEOUT if the client cannot receive the response
// yet. It is no error if the client is gone.
rcl_ret_t rcl_send_response(const rcl_service_t* service, rmw_request_id_t* response_header, void* ros_response);

const char* rcl_service_get_service_name(const rcl_service_t* service);
const rcl_service_options_t* rcl_service_get_options(const rcl_service_t* service);
rmw_service_t* rcl_service_get_rmw_handle(const rcl_service_t* service);
const rmw_qos_profile_t* rcl_service_request_subscription_get_actual_qos(const rcl_service_t* service);
const rmw_qos_profile_t* rcl_service_response_publisher_get_actual_qos(const rcl_service_t* service);
bool rcl_service_is_valid(const rcl_service_t* service);

// `callback` is called for every request that arrives, and at once for those that wait to be taken. Null ends the
// calls: none is running any more when this returns. Must not be called from the callback.
rcl_ret_t rcl_service_set_on_new_request_callback(const rcl_service_t* service, rcl_event_callback_t callback,
                                                  const void* user_data);

// Turns on, changes or turns off the introspection of this service: it publishes the requests taken and the responses
// sent on a topic named after the service plus RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX. `type_support` is that of the
// service. The publisher options only apply when it is turned on. The clock gives the events their times; it must live
// until introspection is off or the service is finalized. Thread safe. Returns RCL_RET_SERVICE_INVALID,
// RCL_RET_INVALID_ARGUMENT, or an error of rcl_publisher_init().
rcl_ret_t rcl_service_configure_service_introspection(rcl_service_t* service, rcl_node_t* node, rcl_clock_t* clock,
                                                      const rosidl_service_type_support_t* type_support,
                                                      const rcl_publisher_options_t publisher_options,
                                                      rcl_service_introspection_state_t introspection_state);

#ifdef __cplusplus
}
#endif
