// SPDX-License-Identifier: Apache-2.0
// The publishers and subscriptions of a topic, in the whole system.
#pragma once

#include "rmw/topic_endpoint_info.h"

#ifdef __cplusplus
extern "C" {
#endif

// Takes the full topic name. With `no_mangle`, name and types are those of DDS. `info` must be zero initialized.
rmw_ret_t rmw_get_publishers_info_by_topic(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                           const char* topic_name, bool no_mangle,
                                           rmw_topic_endpoint_info_array_t* info);
rmw_ret_t rmw_get_subscriptions_info_by_topic(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                              const char* topic_name, bool no_mangle,
                                              rmw_topic_endpoint_info_array_t* info);

#ifdef __cplusplus
}
#endif
