// SPDX-License-Identifier: Apache-2.0
// How a wait of a WaitSet ended.
#pragma once

namespace rclcpp {

enum WaitResultKind {
  Ready,    // something is ready
  Timeout,  // the time was over
  Empty,    // there was nothing to wait for
  Invalid   // the result was moved from
};

}  // namespace rclcpp
