// SPDX-License-Identifier: Apache-2.0
// The statistics of a subscription, from its options.
#pragma once

#include <memory>

#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/node_interfaces/node_timers.hpp"
#include "rclcpp/node_interfaces/node_topics.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp {

namespace topic_statistics {
class SubscriptionTopicStatistics;
}

namespace detail {

// With a publisher and a timer of their own; null unless options or node want them. Throws std::invalid_argument for a
// period that is not positive, and what creating a publisher throws.
std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> make_topic_statistics(
    const SubscriptionOptionsBase& options, node_interfaces::NodeBaseInterface& node_base,
    node_interfaces::NodeTopicsInterface& node_topics, node_interfaces::NodeTimersInterface& node_timers);

}  // namespace detail

}  // namespace rclcpp
