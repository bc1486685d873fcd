// SPDX-License-Identifier: Apache-2.0
// Turns an error of rcl_action into an exception.
#pragma once

#include <rcl/types.h>

#include <rclcpp/exceptions.hpp>

namespace rclcpp_action {

inline void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace rclcpp_action
