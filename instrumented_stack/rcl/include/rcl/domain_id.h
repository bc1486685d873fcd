// SPDX-License-Identifier: Apache-2.0
// ROS_DOMAIN_ID.
#pragma once

#include <stddef.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// RCL_DEFAULT_DOMAIN_ID is left alone when the variable is not set. RCL_RET_ERROR when it is no number.
rcl_ret_t rcl_get_default_domain_id(size_t* domain_id);

#ifdef __cplusplus
}
#endif
