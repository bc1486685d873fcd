// SPDX-License-Identifier: Apache-2.0
// Waiting again for the same entities, of which there may be thousands, without a look at each of them.
#pragma once

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Waits for what the last rmw_wait() with this wait set waited for. No entry of that one's arrays was null, and all
// entities must still live. The arrays are not touched: `ready` gets indices, ascending, counted through the arrays of
// subscriptions, services, clients, events and guard conditions in this order; it is valid until the next wait.
rmw_ret_t rmw_wait_again(rmw_wait_set_t* wait_set, const rmw_time_t* wait_timeout, const size_t** ready,
                         size_t* ready_count);

#ifdef __cplusplus
}
#endif
