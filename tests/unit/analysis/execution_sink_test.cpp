// SPDX-License-Identifier: Apache-2.0
// What an analysis tells while it reads.
#include "tracing/model/execution/execution_sink.hpp"

#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tracing/model/analysis/ros2_analysis.hpp"

namespace tracing {
namespace {

struct RecordingSink : ExecutionSink {
  void on_callback(const CallbackInstance& instance) override { callbacks.push_back(instance); }
  void on_publication(const Publication& publication) override { publications.push_back(publication); }
  void on_message(const MessageFlow& message) override { messages.push_back(message); }
  void on_lifecycle_state(const LifecycleInterval& interval) override {
    states.push_back(std::string(interval.state) + (interval.ended ? "" : " …"));
    intervals.push_back(interval);
  }

  std::vector<CallbackInstance> callbacks;
  std::vector<Publication> publications;
  std::vector<MessageFlow> messages;
  std::vector<std::string> states;
  std::vector<LifecycleInterval> intervals;
};

TEST(ExecutionSink, IsToldThePingAndThePong) {
  RecordingSink sink;
  Ros2Analysis analysis(&sink);
  for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
    analysis.on_event({time, static_cast<ProcessId>(thread.vpid), thread.vtid}, event);
  }
  analysis.finish();

  ASSERT_EQ(sink.callbacks.size(), 3u);
  const CallbackInstance& timer = sink.callbacks[0];
  EXPECT_EQ(analysis.model().callbacks()[timer.callback].owner, CallbackObject::Owner::kTimer);
  EXPECT_EQ(timer.thread, (ThreadId{71, 71}));
  EXPECT_EQ(timer.end_ns - timer.begin_ns, 60'000);
  EXPECT_TRUE(timer.finished);

  ASSERT_EQ(sink.publications.size(), 2u);
  ASSERT_EQ(sink.messages.size(), 2u);
  const MessageFlow& ping = sink.messages[0];
  EXPECT_EQ(analysis.model().topics()[ping.publication.topic].name, "/ping");
  EXPECT_EQ(ping.publication.thread, (ThreadId{71, 71}));
  EXPECT_EQ(ping.taking_thread, (ThreadId{72, 72}));
  EXPECT_EQ(ping.callback_begin_ns - ping.publication.published_ns, 150'000);
  EXPECT_GE(ping.publication.rcl_ns, ping.publication.rclcpp_ns);
  EXPECT_GT(ping.publication.rclcpp_ns, timer.begin_ns);
  EXPECT_GT(ping.taken_ns, ping.publication.published_ns);
  ASSERT_TRUE(ping.executor_waited_ns);
  EXPECT_LE(*ping.executor_waited_ns, ping.taken_ns - ping.publication.published_ns);
  EXPECT_EQ(ping.callback, sink.callbacks[1].callback);
}

TEST(ExecutionSink, IsToldOfACallbackWithoutAnEnd) {
  RecordingSink sink;
  Ros2Analysis analysis(&sink);
  analysis.on_event({100, 1, 2}, ros2::CallbackStart{0xcb, false});
  analysis.on_event({150, 1, 2}, ros2::RclTake{0});
  analysis.finish();
  ASSERT_EQ(sink.callbacks.size(), 1u);
  EXPECT_FALSE(sink.callbacks[0].finished);
  EXPECT_EQ(sink.callbacks[0].end_ns, 150);
}

TEST(ExecutionSink, IsToldOfAMessageThatReachesNoCallback) {
  RecordingSink sink;
  Ros2Analysis analysis(&sink);
  analysis.on_event({10, 1, 2}, ros2::RmwSubscriptionInit{2, {}});
  analysis.on_event({20, 1, 2}, ros2::RclSubscriptionInit{12, 0, 2, "/topic", 1});
  analysis.on_event({30, 1, 2}, ros2::RmwTake{2, 9, 777, true});
  analysis.on_event({40, 1, 2}, ros2::RclcppExecutorWaitForWork{-1});
  ASSERT_EQ(sink.messages.size(), 1u);
  EXPECT_EQ(sink.messages[0].callback, kNoObject);
  EXPECT_EQ(sink.messages[0].publication.publisher, kNoObject);
  EXPECT_EQ(sink.messages[0].taken_ns, 30);
}

TEST(ExecutionSink, IsToldTheStatesOfALifecycleNode) {
  RecordingSink sink;
  Ros2Analysis analysis(&sink);
  analysis.on_event({10, 1, 2}, ros2::RclNodeInit{3, 0, "camera", "/"});
  analysis.on_event({20, 1, 2}, ros2::RclLifecycleStateMachineInit{3, 5});
  analysis.on_event({120, 1, 2}, ros2::RclLifecycleTransition{5, "unconfigured", "configuring"});
  analysis.on_event({150, 1, 2}, ros2::RclLifecycleTransition{5, "configuring", "inactive"});
  analysis.on_event({200, 1, 2}, ros2::RclTake{0});
  analysis.finish();
  EXPECT_EQ(sink.states, (std::vector<std::string>{"unconfigured", "configuring", "inactive …"}));
  EXPECT_EQ(sink.intervals[0].node, 0u);
  EXPECT_EQ(sink.intervals[0].begin_ns, 20);
  EXPECT_EQ(sink.intervals[0].end_ns, 120);
  EXPECT_EQ(sink.intervals[2].end_ns, 200);
}

TEST(ExecutionSink, IsToldTheStateOfALifecycleNodeThatIsOlderThanTheSession) {
  RecordingSink sink;
  Ros2Analysis analysis(&sink);
  analysis.on_event({20, 1, 2}, ros2::RclLifecycleStateMachineInit{3, 5});
  analysis.on_lifecycle_state({30, 1, 2}, 5, "active");
  analysis.on_event({90, 1, 2}, ros2::RclLifecycleTransition{5, "active", "deactivating"});
  EXPECT_EQ(sink.states, (std::vector<std::string>{"active"}));
  EXPECT_EQ(sink.intervals[0].begin_ns, 30);
}

}  // namespace
}  // namespace tracing
