// SPDX-License-Identifier: Apache-2.0
// Checks topic names before expansion: relative names, `~` and `{substitutions}` are allowed.
#pragma once

#include <stddef.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_TOPIC_NAME_VALID 0
#define RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING 1
#define RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH 2
#define RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS 3
#define RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER 4
#define RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE 5
#define RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE 6
#define RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH 7
#define RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS 8
#define RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER 9

// `validation_result` gets one of the codes, `invalid_index` (may be null) the position of the offending character.
rcl_ret_t rcl_validate_topic_name(const char* topic_name, int* validation_result, size_t* invalid_index);

// Returns a sentence without a full stop; null for RCL_TOPIC_NAME_VALID.
const char* rcl_topic_name_validation_result_string(int validation_result);

#ifdef __cplusplus
}
#endif
