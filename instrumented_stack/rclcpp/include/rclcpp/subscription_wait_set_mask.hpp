// SPDX-License-Identifier: Apache-2.0
// Which parts of a subscription a WaitSet waits for.
#pragma once

namespace rclcpp {

struct SubscriptionWaitSetMask {
  bool include_subscription = true;
  bool include_events = true;
  bool include_intra_process_waitable = true;
};

}  // namespace rclcpp
