// SPDX-License-Identifier: Apache-2.0
// Turns a name as written in a program into a full name.
#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// `chatter` → `/ns/chatter`, `~/x` → `/ns/node/x`, `{node}` → node name, `{ns}` and `{namespace}` → namespace. Returns
// RCL_RET_TOPIC_NAME_INVALID or RCL_RET_UNKNOWN_SUBSTITUTION on errors. Free the output with `allocator`.
rcl_ret_t rcl_expand_topic_name(const char* input_topic_name, const char* node_name, const char* node_namespace,
                                rcl_allocator_t allocator, char** output_topic_name);

#ifdef __cplusplus
}
#endif
