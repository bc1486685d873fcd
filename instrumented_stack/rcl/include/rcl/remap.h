// SPDX-License-Identifier: Apache-2.0
// Applies remap rules. The first rule that matches is applied. `local_arguments` of the node come before
// `global_arguments` of the process. Either may be null. The output is null if no rule matches. Otherwise free it with
// the allocator.
#pragma once

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// `topic_name` must be fully expanded.
rcl_ret_t rcl_remap_topic_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                               const char* topic_name, const char* node_name, const char* node_namespace,
                               rcl_allocator_t allocator, char** output_name);
rcl_ret_t rcl_remap_service_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                                 const char* service_name, const char* node_name, const char* node_namespace,
                                 rcl_allocator_t allocator, char** output_name);

// Rules `__node:=`, `__name:=` and `__ns:=`, each with an optional `node:` in front.
rcl_ret_t rcl_remap_node_name(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                              const char* node_name, rcl_allocator_t allocator, char** output_name);
rcl_ret_t rcl_remap_node_namespace(const rcl_arguments_t* local_arguments, const rcl_arguments_t* global_arguments,
                                   const char* node_name, rcl_allocator_t allocator, char** output_namespace);

#ifdef __cplusplus
}
#endif
