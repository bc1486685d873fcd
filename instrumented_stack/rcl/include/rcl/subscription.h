// SPDX-License-Identifier: Apache-2.0
// Receiving from a topic.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rcl/event_callback.h"
#include "rcl/node.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_subscription_impl_s rcl_subscription_impl_t;

typedef struct rcl_subscription_s {
  rcl_subscription_impl_t* impl;
} rcl_subscription_t;

typedef struct rcl_subscription_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
  rmw_subscription_options_t rmw_subscription_options;
  // True: messages are always copied, never loaned from the middleware.
  bool disable_loaned_message;
} rcl_subscription_options_t;

typedef struct rcl_subscription_content_filter_options_s {
  rmw_subscription_content_filter_options_t rmw_subscription_content_filter_options;
} rcl_subscription_content_filter_options_t;

rcl_subscription_content_filter_options_t rcl_get_zero_initialized_subscription_content_filter_options(void);
// Uses the allocator of the subscription.
rcl_ret_t rcl_subscription_content_filter_options_init(const rcl_subscription_t* subscription,
                                                       const char* filter_expression, size_t expression_parameters_argc,
                                                       const char* const expression_parameter_argv[],
                                                       rcl_subscription_content_filter_options_t* options);
rcl_ret_t rcl_subscription_content_filter_options_fini(const rcl_subscription_t* subscription,
                                                       rcl_subscription_content_filter_options_t* options);

rcl_subscription_t rcl_get_zero_initialized_subscription(void);
// Loans are disabled unless ROS_DISABLE_LOANED_MESSAGES is 0.
rcl_subscription_options_t rcl_subscription_get_default_options(void);
// Call it after rcl_subscription_options_set_content_filter_options().
rcl_ret_t rcl_subscription_options_fini(rcl_subscription_options_t* option);
// Copies the strings into the options. An empty expression lets every message pass.
rcl_ret_t rcl_subscription_options_set_content_filter_options(const char* filter_expression,
                                                              size_t expression_parameters_argc,
                                                              const char* const expression_parameter_argv[],
                                                              rcl_subscription_options_t* options);

// Creates the subscription on the expanded and remapped topic. Fires rcl_subscription_init with that name and the
// requested depth. Returns RCL_RET_TOPIC_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_subscription_init(rcl_subscription_t* subscription, const rcl_node_t* node,
                                const rosidl_message_type_support_t* type_support, const char* topic_name,
                                const rcl_subscription_options_t* options);
rcl_ret_t rcl_subscription_fini(rcl_subscription_t* subscription, rcl_node_t* node);

// Takes the next message. Returns RCL_RET_SUBSCRIPTION_TAKE_FAILED if there is none. `message_info` may be null.
rcl_ret_t rcl_take(const rcl_subscription_t* subscription, void* ros_message, rmw_message_info_t* message_info,
                   rmw_subscription_allocation_t* allocation);
rcl_ret_t rcl_take_serialized_message(const rcl_subscription_t* subscription,
                                      rcl_serialized_message_t* serialized_message, rmw_message_info_t* message_info,
                                      rmw_subscription_allocation_t* allocation);

// Takes the next message without copying it, to be read and returned. Works only with
// rcl_subscription_can_loan_messages(): otherwise returns RCL_RET_UNSUPPORTED.
rcl_ret_t rcl_take_loaned_message(const rcl_subscription_t* subscription, void** loaned_message,
                                  rmw_message_info_t* message_info, rmw_subscription_allocation_t* allocation);
rcl_ret_t rcl_return_loaned_message_from_subscription(const rcl_subscription_t* subscription, void* loaned_message);

const char* rcl_subscription_get_topic_name(const rcl_subscription_t* subscription);
const rcl_subscription_options_t* rcl_subscription_get_options(const rcl_subscription_t* subscription);
rmw_subscription_t* rcl_subscription_get_rmw_handle(const rcl_subscription_t* subscription);
const rmw_qos_profile_t* rcl_subscription_get_actual_qos(const rcl_subscription_t* subscription);
rcl_ret_t rcl_subscription_get_publisher_count(const rcl_subscription_t* subscription, size_t* publisher_count);
bool rcl_subscription_is_valid(const rcl_subscription_t* subscription);
// Whether it may have a content filter: every one may.
bool rcl_subscription_is_cft_supported(const rcl_subscription_t* subscription);
// Whether there is a content filter; see rmw/subscription_content_filter_options.h.
bool rcl_subscription_is_cft_enabled(const rcl_subscription_t* subscription);
// Like rmw_subscription_set_content_filter() and rmw_subscription_get_content_filter().
rcl_ret_t rcl_subscription_set_content_filter(const rcl_subscription_t* subscription,
                                              const rcl_subscription_content_filter_options_t* options);
rcl_ret_t rcl_subscription_get_content_filter(const rcl_subscription_t* subscription,
                                              rcl_subscription_content_filter_options_t* options);
bool rcl_subscription_can_loan_messages(const rcl_subscription_t* subscription);

// `callback` is called for every message that arrives, and at once for those that wait to be taken. Null ends the
// calls: none is running any more when this returns. Must not be called from the callback.
rcl_ret_t rcl_subscription_set_on_new_message_callback(const rcl_subscription_t* subscription,
                                                       rcl_event_callback_t callback, const void* user_data);

#ifdef __cplusplus
}
#endif
