// SPDX-License-Identifier: Apache-2.0
// The options of rcl_init() besides the command line.
#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"
#include "rmw/init.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_DEFAULT_DOMAIN_ID RMW_DEFAULT_DOMAIN_ID

typedef struct rcl_init_options_impl_s rcl_init_options_impl_t;

typedef struct rcl_init_options_s {
  rcl_init_options_impl_t* impl;
} rcl_init_options_t;

rcl_init_options_t rcl_get_zero_initialized_init_options(void);
rcl_ret_t rcl_init_options_init(rcl_init_options_t* init_options, rcl_allocator_t allocator);
rcl_ret_t rcl_init_options_copy(const rcl_init_options_t* src, rcl_init_options_t* dst);
rcl_ret_t rcl_init_options_fini(rcl_init_options_t* init_options);

// RCL_DEFAULT_DOMAIN_ID means that ROS_DOMAIN_ID decides.
rcl_ret_t rcl_init_options_get_domain_id(const rcl_init_options_t* init_options, size_t* domain_id);
rcl_ret_t rcl_init_options_set_domain_id(rcl_init_options_t* init_options, size_t domain_id);

rmw_init_options_t* rcl_init_options_get_rmw_init_options(rcl_init_options_t* init_options);

#ifdef __cplusplus
}
#endif
