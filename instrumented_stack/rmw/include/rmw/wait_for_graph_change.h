// SPDX-License-Identifier: Apache-2.0
// Waits for a change of the graph without a wait set. ROS 2's rmw has no such function: every client library has a
// thread for it there, because the graph guard condition wakes only one of several waiting threads.
#pragma once

#include "rmw/time.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Waits until the number of changes differs from `*number`, for at most `timeout` nanoseconds (negative: without
// limit), and stores the new number there. Returns RMW_RET_TIMEOUT when the time is over; a timeout of 0 just reads the
// number. Also returns, with RMW_RET_OK, when the context is shut down. Any number of threads may wait.
rmw_ret_t rmw_wait_for_graph_change(const rmw_node_t* node, uint64_t* number, rmw_duration_t timeout);

#ifdef __cplusplus
}
#endif
