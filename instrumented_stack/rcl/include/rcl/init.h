// SPDX-License-Identifier: Apache-2.0
// Start and end of a context.
#pragma once

#include "rcl/context.h"
#include "rcl/init_options.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Parses the command line and starts the middleware. The context must be zero-initialized; nodes can be created with it
// afterwards. Fires the rcl_init tracepoint last. Returns RCL_RET_INVALID_ROS_ARGS for a wrong argument.
rcl_ret_t rcl_init(int argc, char const* const* argv, const rcl_init_options_t* options, rcl_context_t* context);

// Makes the context invalid. Returns RCL_RET_ALREADY_SHUTDOWN the second time.
rcl_ret_t rcl_shutdown(rcl_context_t* context);

#ifdef __cplusplus
}
#endif
