// SPDX-License-Identifier: Apache-2.0
// Turns a name as written in a program into a full name.
#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"
#include "rcutils/types/string_map.h"

#ifdef __cplusplus
extern "C" {
#endif

// `chatter` → `/ns/chatter`, `~/x` → `/ns/node/x`, `{node}` → node name, `{ns}` and `{namespace}` → namespace, and what
// `substitutions` has for others. Returns RCL_RET_TOPIC_NAME_INVALID, RCL_RET_UNKNOWN_SUBSTITUTION,
// RCL_RET_NODE_INVALID_NAME or RCL_RET_NODE_INVALID_NAMESPACE on errors. Free the output with `allocator`.
rcl_ret_t rcl_expand_topic_name(const char* input_topic_name, const char* node_name, const char* node_namespace,
                                const rcutils_string_map_t* substitutions, rcl_allocator_t allocator,
                                char** output_topic_name);

// Adds the substitutions that every name may use, besides those that rcl_expand_topic_name() knows itself: there are
// none.
rcl_ret_t rcl_get_default_topic_name_substitutions(rcutils_string_map_t* string_map);

#ifdef __cplusplus
}
#endif
