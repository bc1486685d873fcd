// SPDX-License-Identifier: Apache-2.0
// How a wait of a WaitSet ended.
#pragma once

namespace rclcpp {

enum WaitResultKind {
  Ready,    // an entity is ready
  Timeout,  // the time was over
  Empty,    // there was no entity to wait for
  Invalid   // the result was moved from
};

}  // namespace rclcpp
