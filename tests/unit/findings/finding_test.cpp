// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/finding.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tracing {
namespace {

// A timer of 100 ms that usually is 50 ms late.
CallbackResult late_timer_of(const std::string& node) {
  CallbackResult timer;
  timer.node = node;
  timer.owner = CallbackResult::Owner::kTimer;
  timer.period_ns = 100'000'000;
  timer.jitter.count = 20;
  timer.jitter.p50_ns = timer.jitter.max_ns = 50'000'000;
  return timer;
}

// It has lost two of twelve messages on /scan.
SubscriptionResult lossy_subscription_of(const std::string& node) {
  SubscriptionResult subscription;
  subscription.node = node;
  subscription.topic = "/scan";
  subscription.delivered = 10;
  subscription.lost = 2;
  return subscription;
}

TEST(Finding, SaysWhichCallbackOrTopicItIsAbout) {
  TraceResults results;
  CallbackResult timer = late_timer_of("/slow");
  timer.id = 7;
  results.ros2.callbacks = {timer};
  results.ros2.subscriptions = {lossy_subscription_of("/slow")};

  const std::vector<Finding> findings = find_worth_a_look(results);

  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDroppedMessages);
  EXPECT_EQ(findings[0].topic, "/scan");
  EXPECT_EQ(findings[0].callback, std::nullopt);
  EXPECT_EQ(findings[1].kind, Finding::Kind::kWorstJitter);
  EXPECT_EQ(findings[1].callback, 7u);
  EXPECT_EQ(findings[1].topic, "");
}

TEST(Finding, NamesTheMachineIfThereAreSeveral) {
  TraceResults results;
  results.overview.processes = {{71, "ping", 1, false, "left"}, {71, "ping", 1, false, "right"}};
  CallbackResult timer = late_timer_of("/ping");
  timer.process = 1;
  results.ros2.callbacks = {timer};
  results.ros2.subscriptions = {lossy_subscription_of("/pong")};
  CallResult call;
  call.service = "/add";
  call.client = "/asker";
  call.client_process = 1;
  call.requests = 4;
  results.ros2.calls = {call};

  const std::vector<Finding> findings = find_worth_a_look(results);

  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].subject, "/scan to left: /pong");
  EXPECT_EQ(findings[1].figures, "4 of 4 requests from right: /asker got no response");
  EXPECT_EQ(findings[2].subject, "right: /ping, timer 100 ms");
}

// Its timer is called as it should be, its chain takes less than a millisecond, its executor waits.
TEST(Finding, ThereIsNoneInAHealthySystem) {
  TraceResults results;
  results.overview.processes = {{71, "ping", 1, false, ""}};
  results.overview.begin_ns = 0;
  results.overview.end_ns = 10'000'000'000;
  CallbackResult timer = late_timer_of("/ping");
  timer.jitter.p50_ns = 200'000;
  timer.jitter.max_ns = 60'000'000;  // a stall of the machine
  timer.interval.count = 20;
  timer.interval.p50_ns = timer.period_ns + 20'000;
  timer.durations.count = 20;
  timer.durations.mean_ns = 100'000;
  results.ros2.callbacks = {timer};
  ChainResult chain;
  chain.steps.resize(2);
  chain.response.count = 20;
  chain.response.p50_ns = 462'000;
  chain.response.p99_ns = 60'000'000;
  results.ros2.chains = {chain};
  ExecutorResult executor;
  executor.callbacks = 20;
  executor.utilisation = 0.00018;
  results.ros2.executors = {executor};
  EXPECT_TRUE(find_worth_a_look(results).empty());
}

TEST(Finding, NamesTheSlowestOfSlowStarts) {
  TraceResults results;
  for (const std::int64_t seconds : {6, 20, 9}) {
    StartResult start;
    start.process = "slow-" + std::to_string(seconds);
    start.vpid = seconds;
    start.ready_after_ns = seconds * 1'000'000'000;
    results.starts.push_back(start);
  }
  const std::vector<Finding> findings = find_worth_a_look(results);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "slow-20 [20]");
}

TEST(Finding, NamesATimerThatDrifts) {
  TraceResults results;
  CallbackResult timer = late_timer_of("/slow");
  timer.jitter.p50_ns = timer.jitter.max_ns = 4'000'000;
  timer.interval.count = 20;
  timer.interval.p50_ns = 103'000'000;
  results.ros2.callbacks = {timer};
  const std::vector<Finding> findings = find_worth_a_look(results);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDriftingTimer);
  EXPECT_EQ(findings[0].figures, "usually called after 103 ms, 3 % off its period");
}

TEST(Finding, NamesACallbackThatDominatesOnceAndNotItsExecutor) {
  TraceResults results;
  results.overview.processes = {{71, "fusion", 1, false, ""}};
  results.overview.begin_ns = 0;
  results.overview.end_ns = 10'000'000'000;
  CallbackResult timer = late_timer_of("/fusion");
  timer.id = 3;
  timer.jitter.p50_ns = timer.jitter.max_ns = 6'000'000;
  timer.durations.count = 100;
  timer.durations.mean_ns = 60'000'000;
  timer.durations.p50_ns = 60'000'000;
  timer.durations.max_ns = 65'000'000;
  results.ros2.callbacks = {timer};
  ExecutorResult executor;
  executor.callbacks = 100;
  executor.utilisation = 0.61;
  executor.longest_busy_ns = 66'000'000;
  executor.longest_callback = "/fusion, timer 100 ms";
  results.ros2.executors = {executor};
  const std::vector<Finding> findings = find_worth_a_look(results);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDominatingCallback);
  EXPECT_EQ(findings[0].subject, "/fusion, timer 100 ms");
  EXPECT_EQ(findings[0].figures, "its 100 runs take 60 % of the time, usually 60.0 ms each, at most 65.0 ms");
}

// A callback of 100 ms keeps a timer of 20 ms and a subscription waiting.
TEST(Finding, NamesACallbackThatOthersWaitForOnceAndNotTheOthers) {
  TraceResults results;
  results.overview.processes = {{71, "both", 1, false, ""}};
  CallbackResult hog = late_timer_of("/hog");
  hog.id = 1;
  hog.period_ns = 500'000'000;
  hog.symbol = "Hog::work()";
  hog.jitter = {};
  hog.durations.count = 20;
  CallbackResult victim = late_timer_of("/victim");
  victim.id = 2;
  victim.period_ns = 20'000'000;
  victim.missed = 80;
  victim.durations.count = 400;
  victim.held_up_by_id = hog.id;
  victim.held_up = 20;
  victim.held_up_ns = 20 * 80'000'000LL;
  CallbackResult listener;
  listener.id = 3;
  listener.owner = CallbackResult::Owner::kSubscription;
  listener.node = "/victim";
  listener.owner_name = "/scan";
  listener.durations.count = 400;
  listener.held_up_by_id = hog.id;
  listener.held_up = 20;
  listener.held_up_ns = 20 * 50'000'000LL;
  results.ros2.callbacks = {hog, victim, listener};
  SubscriptionResult subscription;
  subscription.node = "/victim";
  subscription.topic = "/scan";
  subscription.executor.count = 400;
  subscription.executor.p90_ns = 50'000'000;
  results.ros2.subscriptions = {subscription};

  const std::vector<Finding> findings = find_worth_a_look(results);

  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Finding::Kind::kBlockingCallback);
  EXPECT_EQ(findings[0].subject, "/hog, timer 500 ms");
  EXPECT_EQ(findings[0].figures,
            "holds up /victim, timer 20 ms for 80.0 ms each, 20 times (80 periods missed), and 1 more");
  EXPECT_EQ(findings[0].next, "give /hog, timer 500 ms (Hog::work) an executor of its own, or shorten it");
}

TEST(Finding, SaysWhatToDo) {
  TraceResults results;
  SubscriptionResult subscription = lossy_subscription_of("/slow");
  subscription.queue_depth = 5;
  subscription.overwritten = 3;
  results.ros2.subscriptions = {subscription};
  const std::vector<Finding> findings = find_worth_a_look(results);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].next, "a longer queue than 5, or shorter callbacks in its thread");
}

TEST(Finding, ThereIsNoneInAnEmptyTrace) {
  EXPECT_TRUE(find_worth_a_look({}).empty());
}

}  // namespace
}  // namespace tracing
