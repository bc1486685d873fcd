// SPDX-License-Identifier: Apache-2.0
// Publishing on a topic.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rcl/node.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_publisher_impl_s rcl_publisher_impl_t;

typedef struct rcl_publisher_s {
  rcl_publisher_impl_t* impl;
} rcl_publisher_t;

typedef struct rcl_publisher_options_s {
  rmw_qos_profile_t qos;
  rcl_allocator_t allocator;
  rmw_publisher_options_t rmw_publisher_options;
} rcl_publisher_options_t;

rcl_publisher_t rcl_get_zero_initialized_publisher(void);
rcl_publisher_options_t rcl_publisher_get_default_options(void);

// Creates the publisher on the expanded and remapped topic. Fires rcl_publisher_init with that name and the requested
// depth. Returns RCL_RET_TOPIC_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_publisher_init(rcl_publisher_t* publisher, const rcl_node_t* node,
                             const rosidl_message_type_support_t* type_support, const char* topic_name,
                             const rcl_publisher_options_t* options);
rcl_ret_t rcl_publisher_fini(rcl_publisher_t* publisher, rcl_node_t* node);

rcl_ret_t rcl_publish(const rcl_publisher_t* publisher, const void* ros_message,
                      rmw_publisher_allocation_t* allocation);
rcl_ret_t rcl_publish_serialized_message(const rcl_publisher_t* publisher,
                                         const rcl_serialized_message_t* serialized_message,
                                         rmw_publisher_allocation_t* allocation);

// Borrows memory of the middleware for a message, not initialised; see rmw_borrow_loaned_message(). Returns
// RCL_RET_UNSUPPORTED unless rcl_publisher_can_loan_messages().
rcl_ret_t rcl_borrow_loaned_message(const rcl_publisher_t* publisher, const rosidl_message_type_support_t* type_support,
                                    void** ros_message);
rcl_ret_t rcl_return_loaned_message_from_publisher(const rcl_publisher_t* publisher, void* loaned_message);
// Also takes the loan back.
rcl_ret_t rcl_publish_loaned_message(const rcl_publisher_t* publisher, void* ros_message,
                                     rmw_publisher_allocation_t* allocation);

rcl_ret_t rcl_publisher_assert_liveliness(const rcl_publisher_t* publisher);

// The timeout is in nanoseconds; a negative one waits forever.
rcl_ret_t rcl_publisher_wait_for_all_acked(const rcl_publisher_t* publisher, rmw_duration_t timeout);

const char* rcl_publisher_get_topic_name(const rcl_publisher_t* publisher);
const rcl_publisher_options_t* rcl_publisher_get_options(const rcl_publisher_t* publisher);
rmw_publisher_t* rcl_publisher_get_rmw_handle(const rcl_publisher_t* publisher);
rcl_context_t* rcl_publisher_get_context(const rcl_publisher_t* publisher);
const rmw_qos_profile_t* rcl_publisher_get_actual_qos(const rcl_publisher_t* publisher);
rcl_ret_t rcl_publisher_get_subscription_count(const rcl_publisher_t* publisher, size_t* subscription_count);
bool rcl_publisher_is_valid(const rcl_publisher_t* publisher);
bool rcl_publisher_is_valid_except_context(const rcl_publisher_t* publisher);
bool rcl_publisher_can_loan_messages(const rcl_publisher_t* publisher);

#ifdef __cplusplus
}
#endif
