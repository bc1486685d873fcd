// SPDX-License-Identifier: Apache-2.0
// Turns an error of rcl into an exception.
#pragma once

#include <rcl/types.h>

#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

// Throws the exception for `ret`, with `what` before the message of rcl, unless `ret` is RCL_RET_OK.
inline void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace rclcpp::detail
