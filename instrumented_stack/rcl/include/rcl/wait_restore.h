// SPDX-License-Identifier: Apache-2.0
// Waiting again for the same entities without adding each of them again: what an executor does all the time.
#pragma once

#include "rcl/wait.h"

#ifdef __cplusplus
extern "C" {
#endif

// Remembers what has been added since rcl_wait_set_clear() or rcl_wait_set_resize(), which forget it.
rcl_ret_t rcl_wait_set_keep(rcl_wait_set_t* wait_set);

// Instead of clearing and adding: the wait set is as it was when rcl_wait_set_keep() was called, and more can be added.
// All that was kept must still live. Its entries may be null until the wait, which leaves those of it that are ready.
// RCL_RET_WAIT_SET_EMPTY if nothing was kept.
rcl_ret_t rcl_wait_set_restore(rcl_wait_set_t* wait_set);

// Indices, ascending, into an array of the wait set.
typedef struct rcl_wait_set_left_indices_s {
  const size_t* indices;
  size_t count;
} rcl_wait_set_left_indices_t;

// Which of the kept entities the last wait has left.
typedef struct rcl_wait_set_left_s {
  rcl_wait_set_left_indices_t timers;
  rcl_wait_set_left_indices_t subscriptions;
  rcl_wait_set_left_indices_t services;
  rcl_wait_set_left_indices_t clients;
  rcl_wait_set_left_indices_t events;
} rcl_wait_set_left_t;

// Null, with an error, for a wait set that is not initialized. Valid until the wait set is changed or waited with.
const rcl_wait_set_left_t* rcl_wait_set_get_left(const rcl_wait_set_t* wait_set);

#ifdef __cplusplus
}
#endif
