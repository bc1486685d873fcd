// SPDX-License-Identifier: Apache-2.0
// Messages of a node's logger on /rosout.
//
// A message of logger `ns.node` or `ns.node.child` is published by the node `/ns/node`.
#pragma once

#include "rcl/node.h"
#include "rcl/types.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

// Creates and removes the node's publisher on /rosout; rcl_node_init() and rcl_node_fini() call these. RCL_RET_OK also
// when the node, or another one with the same logger name, has one already.
rcl_ret_t rcl_logging_rosout_init_publisher_for_node(rcl_node_t* node);
rcl_ret_t rcl_logging_rosout_fini_publisher_for_node(rcl_node_t* node);

// Publishes on behalf of the node with the longest logger name that is `name` or an ancestor of it.
void rcl_logging_rosout_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                       rcutils_time_point_value_t timestamp, const char* format, va_list* args);

#ifdef __cplusplus
}
#endif
