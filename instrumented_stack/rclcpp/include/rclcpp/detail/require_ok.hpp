// SPDX-License-Identifier: Apache-2.0
// What becomes of an error of rcl: an exception, a line in the log, or nothing.
#pragma once

#include <rcl/error_handling.h>
#include <rcl/types.h>

#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

// Throws the exception for `ret`, with `what` before the message of rcl, unless `ret` is RCL_RET_OK.
inline void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

// For destructors and callbacks, which must not throw: logs a failure, with `what` before the message of rcl.
void log_error(rcl_ret_t ret, const char* what);

// For calls whose failure leaves nothing to do. No message of rcl is left for the next error.
inline void ignore_error(rcl_ret_t ret) {
  if (ret != RCL_RET_OK) {
    rcl_reset_error();
  }
}

}  // namespace rclcpp::detail
