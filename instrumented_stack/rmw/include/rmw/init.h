// SPDX-License-Identifier: Apache-2.0
// Start and end of the middleware for one context.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rmw/init_options.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_context_impl_s rmw_context_impl_t;

struct rmw_context_s {
  uint64_t instance_id;
  const char* implementation_identifier;
  rmw_init_options_t options;
  size_t actual_domain_id;
  rmw_context_impl_t* impl;
};

rmw_context_t rmw_get_zero_initialized_context(void);

// Prepares the context. The DDS participant, one per context, is created with the first node and lives until the last
// node is destroyed.
rmw_ret_t rmw_init(const rmw_init_options_t* options, rmw_context_t* context);

// Marks the context as shut down: no new nodes can be created.
rmw_ret_t rmw_shutdown(rmw_context_t* context);

// Frees a context that was shut down and has no nodes.
rmw_ret_t rmw_context_fini(rmw_context_t* context);

#ifdef __cplusplus
}
#endif
