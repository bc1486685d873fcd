// SPDX-License-Identifier: Apache-2.0
// The state between rcl_init() and rcl_shutdown().
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcl/arguments.h"
#include "rcl/init_options.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint64_t rcl_context_instance_id_t;
typedef struct rcl_context_impl_s rcl_context_impl_t;

typedef struct rcl_context_s {
  rcl_arguments_t global_arguments;
  rcl_context_impl_t* impl;
  // 0 while the context is not valid. Read and written atomically, because rcl_shutdown() may run during any query.
  uint64_t instance_id_storage;
} rcl_context_t;

rcl_context_t rcl_get_zero_initialized_context(void);

// Frees a context that was shut down.
rcl_ret_t rcl_context_fini(rcl_context_t* context);

const rcl_init_options_t* rcl_context_get_init_options(const rcl_context_t* context);

// Differs for every rcl_init() of the process; 0 if the context is not valid.
rcl_context_instance_id_t rcl_context_get_instance_id(const rcl_context_t* context);
rcl_ret_t rcl_context_get_domain_id(rcl_context_t* context, size_t* domain_id);

// True between rcl_init() and rcl_shutdown().
bool rcl_context_is_valid(const rcl_context_t* context);
rmw_context_t* rcl_context_get_rmw_context(rcl_context_t* context);

#ifdef __cplusplus
}
#endif
