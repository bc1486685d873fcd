// SPDX-License-Identifier: Apache-2.0
// A condition that any thread can trigger to wake a wait set.
#pragma once

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_guard_condition_impl_s rcl_guard_condition_impl_t;

typedef struct rcl_guard_condition_s {
  rcl_context_t* context;
  rcl_guard_condition_impl_t* impl;
} rcl_guard_condition_t;

typedef struct rcl_guard_condition_options_s {
  rcl_allocator_t allocator;
} rcl_guard_condition_options_t;

rcl_guard_condition_t rcl_get_zero_initialized_guard_condition(void);
rcl_guard_condition_options_t rcl_guard_condition_get_default_options(void);
rcl_ret_t rcl_guard_condition_init(rcl_guard_condition_t* guard_condition, rcl_context_t* context,
                                   const rcl_guard_condition_options_t options);

// Wraps a middleware guard condition without owning it.
rcl_ret_t rcl_guard_condition_init_from_rmw(rcl_guard_condition_t* guard_condition,
                                            const rmw_guard_condition_t* rmw_guard_condition, rcl_context_t* context,
                                            const rcl_guard_condition_options_t options);
rcl_ret_t rcl_guard_condition_fini(rcl_guard_condition_t* guard_condition);

// Thread safe. May be called from a signal-handling thread but not from a signal handler.
rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t* guard_condition);
rmw_guard_condition_t* rcl_guard_condition_get_rmw_handle(const rcl_guard_condition_t* guard_condition);

#ifdef __cplusplus
}
#endif
