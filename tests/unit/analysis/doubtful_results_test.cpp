// SPDX-License-Identifier: Apache-2.0
// Results that lost events may have changed are marked.
#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::TraceWriter;

// Ping and pong with buffers of their own; one of the two loses events.
TraceResults results_with_losses_of(std::int64_t vpid) {
  const TemporaryDirectory directory;
  for (const testing::Thread& process : {testing::kPing, testing::kPong}) {
    TraceWriter writer(directory.path() / std::string(process.procname),
                       {.per_process_vpid = process.vpid, .identity = static_cast<std::uint8_t>(process.vpid)});
    for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
      if (thread.vpid == process.vpid) {
        writer.write(0, time, thread, event);
      }
    }
    if (process.vpid == vpid) {
      writer.end_packet(0);
      writer.discard_events(0, 12);
      writer.write(0, testing::kPingPongBegin + 600'000'000, process, ros2::RclTake{1});
    }
    writer.finish();
  }
  TraceAnalysis analysis;
  TraceReader(directory.path()).read(analysis);
  return analysis.finish();
}

TEST(DoubtfulResults, AreThoseOfTheProcessThatLostEvents) {
  const TraceResults results = results_with_losses_of(testing::kPong.vpid);
  EXPECT_EQ(results.overview.lost_events(), 12u);
  ASSERT_EQ(results.ros2.callbacks.size(), 3u);
  for (const CallbackResult& callback : results.ros2.callbacks) {
    EXPECT_EQ(callback.doubtful, callback.node == "/pong");
  }
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    EXPECT_EQ(subscription.doubtful, subscription.node == "/pong");
  }
  for (const ExecutorResult& executor : results.ros2.executors) {
    EXPECT_EQ(executor.doubtful, executor.vtid == 72);
  }
  // Messages have two ends, and chains many.
  ASSERT_EQ(results.ros2.topics.size(), 2u);
  for (const TopicResult& topic : results.ros2.topics) {
    EXPECT_TRUE(topic.doubtful) << topic.name;
  }
  ASSERT_EQ(results.ros2.chains.size(), 1u);
  EXPECT_TRUE(results.ros2.chains[0].doubtful);
}

TEST(DoubtfulResults, AreNoneWithoutLosses) {
  const TraceResults results = results_with_losses_of(0);
  for (const CallbackResult& callback : results.ros2.callbacks) {
    EXPECT_FALSE(callback.doubtful);
  }
  for (const TopicResult& topic : results.ros2.topics) {
    EXPECT_FALSE(topic.doubtful);
  }
  EXPECT_FALSE(results.ros2.chains.at(0).doubtful);
}

}  // namespace
}  // namespace tracing
