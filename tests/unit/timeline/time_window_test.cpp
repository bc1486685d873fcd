// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/time_window.hpp"

#include <gtest/gtest.h>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/traced_example/traced_example.hpp"

namespace tracing::timeline {
namespace {

using testing::kExampleFirstCycle;
using testing::kExamplePeriod;

TEST(TimeWindow, KeepsWhatBeginsInIt) {
  Timeline timeline = testing::traced_example(100).timeline;
  const std::int64_t begin = kExampleFirstCycle + 10 * kExamplePeriod;
  keep_window(timeline, begin, begin + 2 * kExamplePeriod);
  EXPECT_EQ(timeline.begin_ns, begin);
  EXPECT_EQ(timeline.end_ns, begin + 2 * kExamplePeriod);
  ASSERT_EQ(timeline.instances.size(), 6u);
  EXPECT_EQ(timeline.instances[0].start_ns, begin);
  ASSERT_EQ(timeline.messages.size(), 4u);
  EXPECT_EQ(timeline.messages[0].publishing_instance, 0u);
  EXPECT_EQ(timeline.messages[0].receiving_instance, 1u);
  EXPECT_EQ(timeline.instances[1].message, 0u);
  ASSERT_EQ(timeline.lifecycle.size(), 1u);
  EXPECT_EQ(timeline.lifecycle[0].state, "active");
  EXPECT_EQ(timeline.lifecycle[0].begin_ns, begin);
  EXPECT_EQ(timeline.lifecycle[0].end_ns, timeline.end_ns);
  EXPECT_EQ(timeline.nodes.size(), 3u) << "objects stay";
}

TEST(TimeWindow, ForgetsWhatIsOutside) {
  Timeline timeline = testing::traced_example(2).timeline;
  // The first publication is in it, but neither its callback nor the one that gets it.
  keep_window(timeline, kExampleFirstCycle + 50'000, kExampleFirstCycle + 200'000);
  EXPECT_EQ(timeline.instances.size(), 0u);
  ASSERT_EQ(timeline.messages.size(), 1u);
  EXPECT_EQ(timeline.messages[0].publishing_instance, kNone);
  EXPECT_EQ(timeline.messages[0].receiving_instance, kNone);
}

TEST(TimeWindow, IsCutToTheTimeline) {
  Timeline timeline = testing::traced_example(3).timeline;
  const Timeline whole = timeline;
  keep_window(timeline, 0, whole.end_ns + 1'000'000'000);
  EXPECT_EQ(timeline.begin_ns, whole.begin_ns);
  EXPECT_EQ(timeline.end_ns, whole.end_ns);
  EXPECT_EQ(timeline.instances.size(), whole.instances.size());
  EXPECT_EQ(timeline.lifecycle.size(), whole.lifecycle.size());
  keep_window(timeline, whole.end_ns, whole.begin_ns);
  EXPECT_EQ(timeline.instances.size(), 0u);
  EXPECT_EQ(timeline.messages.size(), 0u);
  EXPECT_EQ(timeline.begin_ns, timeline.end_ns);
}

TEST(TimeWindow, EndsWhereItsRecordsEnd) {
  const Timeline timeline = testing::traced_example(10).timeline;
  EXPECT_EQ(end_of_first(timeline, 50), timeline.end_ns);
  const std::int64_t end = end_of_first(timeline, 20);
  Timeline part = timeline;
  keep_window(part, timeline.begin_ns, end);
  EXPECT_EQ(part.instances.size() + part.messages.size(), 20u);
  EXPECT_EQ(end_of_first(Timeline(), 1), 0);
}

}  // namespace
}  // namespace tracing::timeline
