// SPDX-License-Identifier: Apache-2.0
// The options for creating a context.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/discovery_options.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_DEFAULT_DOMAIN_ID SIZE_MAX  // 0 for Fast DDS

typedef struct rmw_init_options_s {
  uint64_t instance_id;
  const char* implementation_identifier;
  size_t domain_id;
  rmw_discovery_options_t discovery_options;
  char* enclave;  // security enclave, announced to others; owned
  rcutils_allocator_t allocator;
} rmw_init_options_t;

rmw_init_options_t rmw_get_zero_initialized_init_options(void);
rmw_ret_t rmw_init_options_init(rmw_init_options_t* init_options, rcutils_allocator_t allocator);
rmw_ret_t rmw_init_options_copy(const rmw_init_options_t* src, rmw_init_options_t* dst);
rmw_ret_t rmw_init_options_fini(rmw_init_options_t* init_options);

#ifdef __cplusplus
}
#endif
