// SPDX-License-Identifier: Apache-2.0
// Check of fully qualified topic names.
#pragma once

#include <stddef.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_TOPIC_VALID 0
#define RMW_TOPIC_INVALID_IS_EMPTY_STRING 1
#define RMW_TOPIC_INVALID_NOT_ABSOLUTE 2
#define RMW_TOPIC_INVALID_ENDS_WITH_FORWARD_SLASH 3
#define RMW_TOPIC_INVALID_CONTAINS_UNALLOWED_CHARACTERS 4
#define RMW_TOPIC_INVALID_CONTAINS_REPEATED_FORWARD_SLASH 5
#define RMW_TOPIC_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER 6
#define RMW_TOPIC_INVALID_TOO_LONG 7

// DDS allows 255 characters. The prefix and suffix of services may take 8 of them.
#define RMW_TOPIC_MAX_NAME_LENGTH (255U - 8U)

// A full name is absolute and has no substitutions: `/ns/chatter`. `validation_result` gets one of the codes above, and
// `invalid_index` (may be null) the position of the offending character.
rmw_ret_t rmw_validate_full_topic_name(const char* topic_name, int* validation_result, size_t* invalid_index);

// Returns a sentence without a full stop; null for RMW_TOPIC_VALID.
const char* rmw_full_topic_name_validation_result_string(int validation_result);

#ifdef __cplusplus
}
#endif
