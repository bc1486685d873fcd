// SPDX-License-Identifier: Apache-2.0
// Selects the messages that a subscription receives. The expression is in the filter language of DDS, a subset of SQL,
// over the fields of the message. `data > %0 AND header.frame_id = %1` has two parameters.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/types/string_array.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_subscription_content_filter_options_s {
  char* filter_expression;  // empty: every message is wanted
  rcutils_string_array_t expression_parameters;
} rmw_subscription_content_filter_options_t;

rmw_subscription_content_filter_options_t rmw_get_zero_initialized_content_filter_options(void);

// Copies the strings; `options` must be zero initialised. Returns RMW_RET_INVALID_ARGUMENT or RMW_RET_BAD_ALLOC on
// errors.
rmw_ret_t rmw_subscription_content_filter_options_init(const char* filter_expression, size_t expression_parameters_argc,
                                                       const char* const expression_parameter_argv[],
                                                       const rcutils_allocator_t* allocator,
                                                       rmw_subscription_content_filter_options_t* options);
// `allocator` is the one used for initialisation. Zero initialised options are left alone.
rmw_ret_t rmw_subscription_content_filter_options_fini(rmw_subscription_content_filter_options_t* options,
                                                       const rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
