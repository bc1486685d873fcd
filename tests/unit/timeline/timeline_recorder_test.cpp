// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/timeline_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"

namespace tracing::timeline {
namespace {

using testing::kExampleBegin;
using testing::kExampleFirstCycle;

class ExampleTimeline : public ::testing::Test {
 protected:
  const Timeline timeline_ = testing::traced_example(100).timeline;
};

TEST_F(ExampleTimeline, HasAllInstancesInTheOrderOfTheirStarts) {
  ASSERT_EQ(timeline_.instances.size(), 298u);
  EXPECT_TRUE(
      std::is_sorted(timeline_.instances.begin(), timeline_.instances.end(),
                     [](const Instance& left, const Instance& right) { return left.start_ns < right.start_ns; }));
  const Instance& first = timeline_.instances[0];
  EXPECT_EQ(first.start_ns, kExampleFirstCycle);
  EXPECT_EQ(first.end_ns, kExampleFirstCycle + 200'000);
  EXPECT_TRUE(first.finished);
  EXPECT_EQ(timeline_.threads[first.thread].vtid, 101);
  const Callback& timer = timeline_.callbacks[first.callback];
  EXPECT_EQ(timer.owner, CallbackResult::Owner::kTimer);
  EXPECT_EQ(timer.period_ns, testing::kExamplePeriod);
  EXPECT_EQ(timer.symbol, "Sensor::on_timer()");
  EXPECT_EQ(timeline_.nodes[timer.node].name, "/sensor");
  EXPECT_EQ(timeline_.processes[timer.process].vpid, 101);
}

TEST_F(ExampleTimeline, FollowsAMessageFromCallbackToCallback) {
  ASSERT_EQ(timeline_.messages.size(), 200u);
  const Message& scan = timeline_.messages[0];
  EXPECT_EQ(timeline_.topics[scan.topic], "/scan");
  EXPECT_EQ(scan.called_ns, kExampleFirstCycle + 95'000);
  EXPECT_EQ(scan.published_ns, kExampleFirstCycle + 100'000);
  EXPECT_EQ(scan.taken_ns, kExampleFirstCycle + 250'000);
  EXPECT_EQ(scan.publishing_instance, 0u);
  EXPECT_EQ(scan.receiving_instance, 1u);
  EXPECT_FALSE(scan.repeated);
  EXPECT_EQ(scan.written_after_ns, 0u) << "the trace has no dds:write";
  EXPECT_EQ(timeline_.instances[1].message, 0u);
  EXPECT_EQ(timeline_.instances[1].start_ns, kExampleFirstCycle + 300'000);
  const Message& points = timeline_.messages[1];
  EXPECT_EQ(points.publishing_instance, 1u);
  EXPECT_EQ(points.receiving_instance, 2u);
}

Timeline timeline_of(const testing::ExampleVariant& variant) {
  const testing::TemporaryDirectory directory;
  testing::write_example_system(directory.path(), 3, testing::ExampleEvents::kRos, variant);
  TimelineRecorder recorder;
  TraceAnalysis analysis(&recorder);
  TraceReader(directory.path()).read(analysis);
  const TraceResults results = analysis.finish();
  return recorder.finish(analysis, results.overview);
}

TEST_F(ExampleTimeline, KnowsWhichMessagesAreKeptForWhichPublisher) {
  EXPECT_TRUE(timeline_.kept.empty());
  const Timeline timeline = timeline_of({.has_links = true});
  ASSERT_EQ(timeline.kept.size(), 1u);
  EXPECT_EQ(timeline.topics[timeline.publishers[timeline.kept[0].publisher].topic], "/points");
  EXPECT_EQ(timeline.topics[timeline.subscriptions[timeline.kept[0].subscription].topic], "/scan");
}

TEST_F(ExampleTimeline, KnowsWhenAMessageWasWritten) {
  const Timeline timeline = timeline_of({.has_writes = true});
  ASSERT_EQ(timeline.messages.size(), 6u);
  for (const Message& message : timeline.messages) {
    EXPECT_EQ(message.written_after_ns, 3'000u);
  }
  static_assert(sizeof(Message) == 64, "a trace has millions of them");
}

TEST_F(ExampleTimeline, KeepsMessagesThatNobodyTook) {
  std::vector<std::int64_t> untaken;
  for (const Message& message : timeline_.messages) {
    if (message.taken_ns == 0) {
      untaken.push_back((message.published_ns - kExampleFirstCycle) / testing::kExamplePeriod);
    }
  }
  EXPECT_EQ(untaken, (std::vector<std::int64_t>{49, 99}));
}

TEST_F(ExampleTimeline, HasTheStatesOfLifecycleNodes) {
  std::vector<std::string> states;
  for (const LifecycleState& state : timeline_.lifecycle) {
    states.push_back(timeline_.nodes[state.node].name + " " + state.state + " " +
                     std::to_string((state.begin_ns - kExampleBegin) / 1000));
  }
  EXPECT_EQ(states,
            (std::vector<std::string>{"/display unconfigured 2300", "/display configuring 5000",
                                      "/display inactive 8000", "/display activating 9000", "/display active 9500"}));
  EXPECT_EQ(timeline_.lifecycle.back().end_ns, timeline_.end_ns);
}

// Two subscriptions take one publication: it is there twice.
TEST(TimelineRecorder, RepeatsAPublicationForEachSubscription) {
  TimelineRecorder recorder;
  TraceAnalysis analysis(&recorder);
  Publication publication{.number = 1, .topic = 0, .publisher = 0, .thread = {0, 1}, .published_ns = 100};
  recorder.on_publication(publication);
  Publication other = publication;
  other.number = 2;
  other.published_ns = 150;
  recorder.on_publication(other);
  recorder.on_message({.publication = publication, .subscription = 1, .taking_thread = {0, 2}, .taken_ns = 120});
  recorder.on_message({.publication = publication, .subscription = 2, .taking_thread = {0, 3}, .taken_ns = 110});
  const Timeline timeline = recorder.finish(analysis, {});
  ASSERT_EQ(timeline.messages.size(), 3u);
  EXPECT_EQ(timeline.messages[0].subscription, 1u);
  EXPECT_FALSE(timeline.messages[0].repeated);
  EXPECT_EQ(timeline.messages[1].subscription, 2u);
  EXPECT_TRUE(timeline.messages[1].repeated);
  EXPECT_EQ(timeline.messages[2].published_ns, 150);
  EXPECT_EQ(timeline.messages[2].subscription, kNone);
  EXPECT_FALSE(timeline.messages[2].repeated);
}

TEST(TimelineRecorder, MarksInstancesWithoutAnEnd) {
  TimelineRecorder recorder;
  TraceAnalysis analysis(&recorder);
  recorder.on_callback({.thread = {0, 1}, .callback = 0, .begin_ns = 10, .end_ns = 90, .finished = false});
  const Timeline timeline = recorder.finish(analysis, {});
  ASSERT_EQ(timeline.instances.size(), 1u);
  EXPECT_FALSE(timeline.instances[0].finished);
}

}  // namespace
}  // namespace tracing::timeline
