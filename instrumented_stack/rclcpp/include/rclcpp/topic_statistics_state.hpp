// SPDX-License-Identifier: Apache-2.0
// Whether a subscription publishes statistics of the messages it receives.
#pragma once

namespace rclcpp {

enum class TopicStatisticsState {
  Enable,
  Disable,
  NodeDefault,
};

}  // namespace rclcpp
