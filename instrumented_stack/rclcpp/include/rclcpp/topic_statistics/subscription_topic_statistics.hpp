// SPDX-License-Identifier: Apache-2.0
// Measures what a subscription receives, and publishes the statistics of each period. Created with a subscription that
// has SubscriptionOptions::topic_stats_options enabled.
#pragma once

#include <rmw/types.h>

#include <memory>
#include <mutex>
#include <optional>
#include <statistics_msgs/msg/metrics_message.hpp>
#include <string>

#include "rclcpp/publisher.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/topic_statistics/moving_average.hpp"

namespace rclcpp::topic_statistics {

// Two metrics, in milliseconds: "message_age", from when a message was sent to when it was received, for messages that
// tell when they were sent; and "message_period", between one message and the next. Thread safe.
class SubscriptionTopicStatistics {
 public:
  using MetricsMessage = statistics_msgs::msg::MetricsMessage;

  // `node_name` is the source in the messages. Throws std::invalid_argument for a null publisher.
  SubscriptionTopicStatistics(const std::string& node_name, Publisher<MetricsMessage>::SharedPtr publisher);
  ~SubscriptionTopicStatistics();

  // `now` is system time, when the message was received.
  void handle_message(const rmw_message_info_t& message_info, const Time& now);

  // A message for each metric; then measures afresh.
  void publish_message_and_reset_measurements();

  // The timer is kept, and cancelled at the end.
  void set_publisher_timer(TimerBase::SharedPtr publisher_timer);

 private:
  const std::string node_name_;
  const Publisher<MetricsMessage>::SharedPtr publisher_;
  TimerBase::SharedPtr timer_;

  std::mutex mutex_;
  MovingAverage age_;
  MovingAverage period_;
  std::optional<Time> last_message_;
  Time window_start_;
};

}  // namespace rclcpp::topic_statistics
