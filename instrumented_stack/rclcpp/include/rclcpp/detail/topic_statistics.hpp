// SPDX-License-Identifier: Apache-2.0
// Creates the statistics of a subscription from its options.
#pragma once

#include <memory>

#include "rclcpp/detail/resolve_enable_topic_statistics.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp {

namespace topic_statistics {
class SubscriptionTopicStatistics;
}

namespace detail {

// They have their own publisher and timer. Null unless options or node enable them. Throws std::invalid_argument for a
// period that is not positive, and what creating a publisher throws.
std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> make_topic_statistics(
    const SubscriptionOptionsBase& options, node_interfaces::NodeBaseInterface& node_base,
    node_interfaces::NodeTopicsInterface& node_topics, node_interfaces::NodeTimersInterface& node_timers);

}  // namespace detail

}  // namespace rclcpp
