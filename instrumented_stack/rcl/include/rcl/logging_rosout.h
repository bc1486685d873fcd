// SPDX-License-Identifier: Apache-2.0
// Publishes the messages of a node's logger on /rosout.
//
// The node `/ns/node` publishes messages of the loggers `ns.node` and `ns.node.child`.
#pragma once

#include "rcl/node.h"
#include "rcl/types.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

// Create and remove the node's publisher on /rosout; rcl_node_init() and rcl_node_fini() call them. They also return
// RCL_RET_OK if the node, or another one with the same logger name, already has a publisher.
rcl_ret_t rcl_logging_rosout_init_publisher_for_node(rcl_node_t* node);
rcl_ret_t rcl_logging_rosout_fini_publisher_for_node(rcl_node_t* node);

// Note and forget that logger `logger_name.sublogger_name` is in use. They change nothing of what is published, because
// messages of all descendants of a node's logger are. Each addition needs a removal. Return RCL_RET_NOT_FOUND if no
// node has logger `logger_name`, and if the sublogger is not in use. Any thread.
rcl_ret_t rcl_logging_rosout_add_sublogger(const char* logger_name, const char* sublogger_name);
rcl_ret_t rcl_logging_rosout_remove_sublogger(const char* logger_name, const char* sublogger_name);

// Publishes for the node with the longest logger name that is `name` or an ancestor of it.
void rcl_logging_rosout_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                       rcutils_time_point_value_t timestamp, const char* format, va_list* args);

#ifdef __cplusplus
}
#endif
