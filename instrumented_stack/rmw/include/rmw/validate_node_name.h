// SPDX-License-Identifier: Apache-2.0
// Check of node names.
#pragma once

#include <stddef.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_NODE_NAME_VALID 0
#define RMW_NODE_NAME_INVALID_IS_EMPTY_STRING 1
#define RMW_NODE_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS 2
#define RMW_NODE_NAME_INVALID_STARTS_WITH_NUMBER 3
#define RMW_NODE_NAME_INVALID_TOO_LONG 4

#define RMW_NODE_NAME_MAX_NAME_LENGTH 255U

// A node name has letters, digits and underscores, and does not start with a digit.
rmw_ret_t rmw_validate_node_name(const char* node_name, int* validation_result, size_t* invalid_index);

const char* rmw_node_name_validation_result_string(int validation_result);

#ifdef __cplusplus
}
#endif
