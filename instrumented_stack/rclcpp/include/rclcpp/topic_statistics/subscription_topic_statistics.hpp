// SPDX-License-Identifier: Apache-2.0
// Measures the messages of a subscription, and publishes the statistics of each period. Created with a subscription if
// SubscriptionOptions::topic_stats_options is enabled.
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

// There are two metrics, in milliseconds. "message_age" is the time from sending to receiving, for messages with a send
// time. "message_period" is the time between two messages. Thread safe.
class SubscriptionTopicStatistics {
 public:
  using MetricsMessage = statistics_msgs::msg::MetricsMessage;

  // `node_name` is the source in the messages. Throws std::invalid_argument for a null publisher.
  SubscriptionTopicStatistics(const std::string& node_name, Publisher<MetricsMessage>::SharedPtr publisher);
  ~SubscriptionTopicStatistics();

  // `now` is the system time at which the message was received.
  void handle_message(const rmw_message_info_t& message_info, const Time& now);

  // Publishes a message for each metric, then starts a new measurement.
  void publish_message_and_reset_measurements();

  // The timer is kept, and cancelled in the destructor.
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
