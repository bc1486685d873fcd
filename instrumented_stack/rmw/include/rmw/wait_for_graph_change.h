// SPDX-License-Identifier: Apache-2.0
// Waiting for a change of the graph without a wait set. Not in ROS 2's rmw, where every client library has a thread for
// it: the graph guard condition wakes only one of those that wait.
#pragma once

#include "rmw/time.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Waits until the number of changes so far is another than `*number`, for at most `timeout` nanoseconds (negative: for
// ever), and puts it there. RMW_RET_TIMEOUT when the time is over; with a timeout of 0 that only asks for the number.
// Also returns, with RMW_RET_OK, when the context is shut down. Any number of threads may wait.
rmw_ret_t rmw_wait_for_graph_change(const rmw_node_t* node, uint64_t* number, rmw_duration_t timeout);

#ifdef __cplusplus
}
#endif
