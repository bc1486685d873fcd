// SPDX-License-Identifier: Apache-2.0
// Events of publishers and subscriptions besides messages.
#pragma once

#include <stdbool.h>

#include "rcl/event_callback.h"
#include "rcl/publisher.h"
#include "rcl/subscription.h"
#include "rmw/event.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rcl_publisher_event_type_e {
  RCL_PUBLISHER_OFFERED_DEADLINE_MISSED,
  RCL_PUBLISHER_LIVELINESS_LOST,
  RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS,
  RCL_PUBLISHER_INCOMPATIBLE_TYPE,
  RCL_PUBLISHER_MATCHED
} rcl_publisher_event_type_t;

typedef enum rcl_subscription_event_type_e {
  RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED,
  RCL_SUBSCRIPTION_LIVELINESS_CHANGED,
  RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS,
  RCL_SUBSCRIPTION_MESSAGE_LOST,
  RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE,
  RCL_SUBSCRIPTION_MATCHED
} rcl_subscription_event_type_t;

typedef struct rcl_event_impl_s rcl_event_impl_t;

typedef struct rcl_event_s {
  rcl_event_impl_t* impl;
} rcl_event_t;

rcl_event_t rcl_get_zero_initialized_event(void);

// The publisher or subscription must outlive the event. Returns RCL_RET_UNSUPPORTED for types that the middleware does
// not know.
rcl_ret_t rcl_publisher_event_init(rcl_event_t* event, const rcl_publisher_t* publisher,
                                   rcl_publisher_event_type_t event_type);
rcl_ret_t rcl_subscription_event_init(rcl_event_t* event, const rcl_subscription_t* subscription,
                                      rcl_subscription_event_type_t event_type);
rcl_ret_t rcl_event_fini(rcl_event_t* event);

// Copies the status (rmw/event.h has the types) into `event_info` and sets its changes back to 0.
rcl_ret_t rcl_take_event(const rcl_event_t* event, void* event_info);
rmw_event_t* rcl_event_get_rmw_handle(const rcl_event_t* event);
bool rcl_event_is_valid(const rcl_event_t* event);

// Null ends the calls: none is running any more when this returns.
rcl_ret_t rcl_event_set_callback(const rcl_event_t* event, rcl_event_callback_t callback, const void* user_data);

#ifdef __cplusplus
}
#endif
