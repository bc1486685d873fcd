// SPDX-License-Identifier: Apache-2.0
// Whether a subscription has statistics, by its options and its node.
#pragma once

#include <stdexcept>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp::detail {

// Throws std::runtime_error for a state that is none.
inline bool resolve_enable_topic_statistics(const SubscriptionOptionsBase& options,
                                            const node_interfaces::NodeBaseInterface& node_base) {
  switch (options.topic_stats_options.state) {
    case TopicStatisticsState::Enable:
      return true;
    case TopicStatisticsState::Disable:
      return false;
    case TopicStatisticsState::NodeDefault:
      return node_base.get_enable_topic_statistics_default();
  }
  throw std::runtime_error("Unrecognized EnableTopicStatistics value");
}

}  // namespace rclcpp::detail
