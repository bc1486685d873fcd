// SPDX-License-Identifier: Apache-2.0
// The state behind rcl_context_t.
#pragma once

#include "rcl/context.h"

struct rcl_context_impl_s {
  rcl_init_options_t init_options = rcl_get_zero_initialized_init_options();
  rmw_context_t rmw_context = rmw_get_zero_initialized_context();
};
