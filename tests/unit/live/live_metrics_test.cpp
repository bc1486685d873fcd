// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

using ::testing::HasSubstr;

std::string metrics_of_the_example() {
  const testing::TemporaryDirectory directory;
  testing::write_example_system(directory.path(), 100);
  LiveMetrics metrics;
  TraceReader(directory.path()).read(metrics);
  return metrics.text();
}

// Whoever asks for the increase of a counter must see it before the first one.
TEST(LiveMetricsOfTheExample, CountFromZeroOn) {
  const std::string text = metrics_of_the_example();
  EXPECT_THAT(text, HasSubstr("\nlaunch_messages_dropped_total{topic=\"/points\",node=\"/display\"} 1\n"
                              "launch_messages_dropped_total{topic=\"/scan\",node=\"/filter\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("\nlaunch_timer_missed_periods_total{node=\"/sensor\",callback=\"timer 10 ms\"} 0\n"));
}

TEST(LiveMetricsOfTheExample, HaveHistogramsOfCallbacksAndMessages) {
  const std::string text = metrics_of_the_example();
  EXPECT_THAT(text,
              HasSubstr("\nlaunch_callback_duration_seconds_count{node=\"/sensor\",callback=\"timer 10 ms\"} 100\n"));
  EXPECT_THAT(text, HasSubstr("\nlaunch_message_latency_seconds_count{topic=\"/scan\",node=\"/filter\"} 100\n"));
}

}  // namespace
}  // namespace tracing
