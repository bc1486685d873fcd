// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/topic_statistics/subscription_topic_statistics.hpp"

#include <chrono>
#include <statistics_msgs/msg/statistic_data_type.hpp>
#include <stdexcept>
#include <utility>

#include "rclcpp/create_timer.hpp"
#include "rclcpp/detail/topic_statistics.hpp"

namespace rclcpp {

namespace topic_statistics {

namespace {

using statistics_msgs::msg::MetricsMessage;
using statistics_msgs::msg::StatisticDataType;
using std::chrono::nanoseconds;

Time system_now() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return Time(std::chrono::duration_cast<nanoseconds>(since_epoch).count(), RCL_SYSTEM_TIME);
}

double milliseconds(int64_t count) {
  return std::chrono::duration<double, std::milli>(nanoseconds(count)).count();
}

MetricsMessage to_message(const std::string& node_name, const char* metric, const Time& start, const Time& stop,
                          const StatisticData& data) {
  MetricsMessage message;
  message.measurement_source_name = node_name;
  message.metrics_source = metric;
  message.unit = "ms";
  message.window_start = start;
  message.window_stop = stop;
  const std::pair<uint8_t, double> points[] = {
      {StatisticDataType::STATISTICS_DATA_TYPE_AVERAGE, data.average},
      {StatisticDataType::STATISTICS_DATA_TYPE_MAXIMUM, data.max},
      {StatisticDataType::STATISTICS_DATA_TYPE_MINIMUM, data.min},
      {StatisticDataType::STATISTICS_DATA_TYPE_SAMPLE_COUNT, static_cast<double>(data.sample_count)},
      {StatisticDataType::STATISTICS_DATA_TYPE_STDDEV, data.standard_deviation}};
  for (const auto& [type, value] : points) {
    message.statistics.emplace_back();
    message.statistics.back().data_type = type;
    message.statistics.back().data = value;
  }
  return message;
}

}  // namespace

SubscriptionTopicStatistics::SubscriptionTopicStatistics(const std::string& node_name,
                                                         Publisher<MetricsMessage>::SharedPtr publisher)
    : node_name_(node_name), publisher_(std::move(publisher)), window_start_(system_now()) {
  if (!publisher_) {
    throw std::invalid_argument("publisher pointer is nullptr");
  }
}

SubscriptionTopicStatistics::~SubscriptionTopicStatistics() {
  if (timer_) {
    timer_->cancel();
  }
}

void SubscriptionTopicStatistics::handle_message(const rmw_message_info_t& message_info, const Time& now) {
  const std::lock_guard lock(mutex_);
  if (message_info.source_timestamp != 0) {
    age_.add(milliseconds(now.nanoseconds() - message_info.source_timestamp));
  }
  if (last_message_) {
    period_.add(milliseconds((now - *last_message_).nanoseconds()));
  }
  last_message_ = now;
}

void SubscriptionTopicStatistics::publish_message_and_reset_measurements() {
  const Time now = system_now();
  std::unique_lock lock(mutex_);
  const StatisticData age = std::exchange(age_, {}).statistics();
  const StatisticData period = std::exchange(period_, {}).statistics();
  const Time start = std::exchange(window_start_, now);
  lock.unlock();
  publisher_->publish(to_message(node_name_, "message_age", start, now, age));
  publisher_->publish(to_message(node_name_, "message_period", start, now, period));
}

void SubscriptionTopicStatistics::set_publisher_timer(TimerBase::SharedPtr publisher_timer) {
  timer_ = std::move(publisher_timer);
}

}  // namespace topic_statistics

namespace detail {

std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> make_topic_statistics(
    const SubscriptionOptionsBase& options, node_interfaces::NodeBaseInterface& node_base,
    node_interfaces::NodeTopicsInterface& node_topics, node_interfaces::NodeTimersInterface& node_timers) {
  using topic_statistics::SubscriptionTopicStatistics;
  if (!resolve_enable_topic_statistics(options, node_base)) {
    return nullptr;
  }
  const auto& wanted = options.topic_stats_options;
  if (wanted.publish_period <= std::chrono::milliseconds::zero()) {
    throw std::invalid_argument("topic_stats_options.publish_period must be greater than 0, specified value of " +
                                std::to_string(wanted.publish_period.count()) + " ms");
  }
  using Metrics = Publisher<SubscriptionTopicStatistics::MetricsMessage>;
  const PublisherOptions publisher_options;
  const auto publisher = std::make_shared<Metrics>(&node_base, wanted.publish_topic, wanted.qos, publisher_options);
  publisher->post_init_setup(&node_base, wanted.publish_topic, wanted.qos, publisher_options);
  node_topics.add_publisher(publisher, options.callback_group);

  const auto statistics = std::make_shared<SubscriptionTopicStatistics>(node_base.get_name(), publisher);
  statistics->set_publisher_timer(create_wall_timer(
      wanted.publish_period,
      [weak = std::weak_ptr(statistics)] {
        if (const auto living = weak.lock()) {
          living->publish_message_and_reset_measurements();
        }
      },
      options.callback_group, &node_base, &node_timers));
  return statistics;
}

}  // namespace detail

}  // namespace rclcpp
