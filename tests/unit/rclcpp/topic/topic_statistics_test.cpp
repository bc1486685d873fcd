// SPDX-License-Identifier: Apache-2.0
// The statistics of a subscription about the messages that it receives.
#include <gmock/gmock.h>

#include <cmath>
#include <rclcpp/topic_statistics/subscription_topic_statistics.hpp>
#include <statistics_msgs/msg/statistic_data_type.hpp>
#include <std_msgs/msg/u_int64.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rclcpp::topic_statistics::MovingAverage;
using rclcpp::topic_statistics::StatisticData;
using rclcpp::topic_statistics::SubscriptionTopicStatistics;
using statistics_msgs::msg::MetricsMessage;
using statistics_msgs::msg::StatisticDataType;
using std_msgs::msg::UInt64;

double value_of(const MetricsMessage& message, uint8_t type) {
  for (const auto& point : message.statistics) {
    if (point.data_type == type) {
      return point.data;
    }
  }
  ADD_FAILURE() << "no statistic " << int{type};
  return 0;
}

TEST(MovingAverageTest, TellsAverageExtremesAndDeviation) {
  MovingAverage average;
  EXPECT_TRUE(std::isnan(average.statistics().average));
  EXPECT_TRUE(std::isnan(average.statistics().standard_deviation));
  EXPECT_EQ(average.statistics().sample_count, 0u);
  for (const double value : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) {
    average.add(value);
  }
  const StatisticData data = average.statistics();
  EXPECT_DOUBLE_EQ(data.average, 5.0);
  EXPECT_DOUBLE_EQ(data.min, 2.0);
  EXPECT_DOUBLE_EQ(data.max, 9.0);
  EXPECT_DOUBLE_EQ(data.standard_deviation, 2.0);
  EXPECT_EQ(data.sample_count, 8u);
}

class TopicStatistics : public RosTest {
 protected:
  TopicStatistics() { executor_.add_node(node_); }

  // Receives the messages of `topic`.
  void listen(const std::string& topic = "/statistics") {
    listener_ = node_->create_subscription<MetricsMessage>(
        topic, 10, [this](const MetricsMessage& message) { messages_.push_back(message); });
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("measured", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::Subscription<MetricsMessage>::SharedPtr listener_;
  std::vector<MetricsMessage> messages_;
};

TEST_F(TopicStatistics, AgeAndPeriodAreMeasuredInMilliseconds) {
  const auto publisher = node_->create_publisher<MetricsMessage>("/statistics", 10);
  listen();
  SubscriptionTopicStatistics statistics("measured", publisher);
  rmw_message_info_t info = rmw_get_zero_initialized_message_info();
  const auto at = [](int64_t milliseconds) { return rclcpp::Time(milliseconds * 1'000'000, RCL_SYSTEM_TIME); };
  info.source_timestamp = at(998).nanoseconds();
  statistics.handle_message(info, at(1000));
  info.source_timestamp = at(1006).nanoseconds();
  statistics.handle_message(info, at(1010));
  info.source_timestamp = 0;  // not known
  statistics.handle_message(info, at(1030));
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  statistics.publish_message_and_reset_measurements();
  ASSERT_TRUE(spin_until(executor_, [&] { return messages_.size() == 2; }));

  const MetricsMessage age = messages_[0];
  EXPECT_EQ(age.measurement_source_name, "measured");
  EXPECT_EQ(age.metrics_source, "message_age");
  EXPECT_EQ(age.unit, "ms");
  EXPECT_EQ(age.statistics.size(), 5u);
  EXPECT_EQ(value_of(age, StatisticDataType::STATISTICS_DATA_TYPE_SAMPLE_COUNT), 2);
  EXPECT_EQ(value_of(age, StatisticDataType::STATISTICS_DATA_TYPE_AVERAGE), 3);
  EXPECT_EQ(value_of(age, StatisticDataType::STATISTICS_DATA_TYPE_MINIMUM), 2);
  EXPECT_EQ(value_of(age, StatisticDataType::STATISTICS_DATA_TYPE_MAXIMUM), 4);
  EXPECT_EQ(value_of(age, StatisticDataType::STATISTICS_DATA_TYPE_STDDEV), 1);
  const MetricsMessage period = messages_[1];
  EXPECT_EQ(period.metrics_source, "message_period");
  EXPECT_EQ(value_of(period, StatisticDataType::STATISTICS_DATA_TYPE_SAMPLE_COUNT), 2);
  EXPECT_EQ(value_of(period, StatisticDataType::STATISTICS_DATA_TYPE_AVERAGE), 15);

  // The next window begins where this one ended; the distance to its first message counts.
  statistics.handle_message(info, at(1040));
  statistics.publish_message_and_reset_measurements();
  ASSERT_TRUE(spin_until(executor_, [&] { return messages_.size() == 4; }));
  EXPECT_EQ(messages_[2].window_start, age.window_stop);
  EXPECT_TRUE(std::isnan(value_of(messages_[2], StatisticDataType::STATISTICS_DATA_TYPE_AVERAGE)));
  EXPECT_EQ(value_of(messages_[3], StatisticDataType::STATISTICS_DATA_TYPE_AVERAGE), 10);
  EXPECT_THROW(SubscriptionTopicStatistics("measured", nullptr), std::invalid_argument);
}

TEST_F(TopicStatistics, SubscriptionPublishesThemOncePerPeriod) {
  rclcpp::SubscriptionOptions options;
  options.topic_stats_options.state = rclcpp::TopicStatisticsState::Enable;
  options.topic_stats_options.publish_topic = "measurements";
  options.topic_stats_options.publish_period = std::chrono::milliseconds(10);
  int received = 0;
  auto subscription = node_->create_subscription<UInt64>(
      "topic", 10, [&](const UInt64&) { ++received; }, options);
  const auto publisher = node_->create_publisher<UInt64>("topic", 10);
  listen("measurements");
  const auto timer = node_->create_wall_timer(std::chrono::milliseconds(1), [&] { publisher->publish(UInt64()); });
  ASSERT_TRUE(spin_until(executor_, [&] {
    for (const MetricsMessage& message : messages_) {
      if (message.metrics_source == "message_age" &&
          value_of(message, StatisticDataType::STATISTICS_DATA_TYPE_SAMPLE_COUNT) > 0) {
        return value_of(message, StatisticDataType::STATISTICS_DATA_TYPE_MINIMUM) >= 0;
      }
    }
    return false;
  }));
  EXPECT_GT(received, 0);
  EXPECT_EQ(messages_[0].measurement_source_name, "measured");
  subscription.reset();
  EXPECT_EQ(node_->count_publishers("measurements"), 0u);
}

TEST_F(TopicStatistics, MessagesWithinTheProcessCountButHaveNoAge) {
  const auto node = std::make_shared<rclcpp::Node>("within", "ns", rclcpp::NodeOptions().use_intra_process_comms(true));
  executor_.add_node(node);
  rclcpp::SubscriptionOptions options;
  options.topic_stats_options.state = rclcpp::TopicStatisticsState::Enable;
  options.topic_stats_options.publish_period = std::chrono::milliseconds(10);
  bool within = true;
  const auto subscription = node->create_subscription<UInt64>(
      "topic", 10,
      [&](const UInt64&, const rclcpp::MessageInfo& info) {
        within = within && info.get_rmw_message_info().from_intra_process;
      },
      options);
  const auto publisher = node->create_publisher<UInt64>("topic", 10);
  listen();
  const auto timer = node->create_wall_timer(std::chrono::milliseconds(1), [&] { publisher->publish(UInt64()); });
  const auto samples = [&](const char* metric) {
    double count = 0;
    for (const MetricsMessage& message : messages_) {
      if (message.metrics_source == metric) {
        count += value_of(message, StatisticDataType::STATISTICS_DATA_TYPE_SAMPLE_COUNT);
      }
    }
    return count;
  };
  EXPECT_TRUE(spin_until(executor_, [&] { return samples("message_period") > 3; }));
  EXPECT_EQ(samples("message_age"), 0);
  EXPECT_TRUE(within);
}

TEST_F(TopicStatistics, NodeDecidesUnlessTheSubscriptionDoes) {
  const auto node =
      std::make_shared<rclcpp::Node>("default", "other", rclcpp::NodeOptions().enable_topic_statistics(true));
  const auto callback = [](const UInt64&) {};
  const auto publishers = [&] {
    return node->get_node_graph_interface()
        ->get_publisher_names_and_types_by_node("default", "/other")
        .count("/statistics");
  };
  rclcpp::SubscriptionOptions disabled;
  disabled.topic_stats_options.state = rclcpp::TopicStatisticsState::Disable;
  const auto without = node->create_subscription<UInt64>("topic", 10, callback, disabled);
  const auto with = node->create_subscription<UInt64>("topic", 10, callback);
  EXPECT_EQ(publishers(), 1u);
}

TEST_F(TopicStatistics, PeriodThatIsNotPositiveIsAnException) {
  rclcpp::SubscriptionOptions options;
  options.topic_stats_options.state = rclcpp::TopicStatisticsState::Enable;
  options.topic_stats_options.publish_period = std::chrono::milliseconds(0);
  try {
    node_->create_subscription<UInt64>(
        "topic", 10, [](const UInt64&) {}, options);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "topic_stats_options.publish_period must be greater than 0, specified value of 0 ms");
  }
}

}  // namespace
