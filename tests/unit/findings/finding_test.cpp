// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/finding.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tracing {
namespace {

// A timer of 100 ms that was 50 ms late once.
CallbackResult late_timer_of(const std::string& node) {
  CallbackResult timer;
  timer.node = node;
  timer.owner = CallbackResult::Owner::kTimer;
  timer.period_ns = 100'000'000;
  timer.jitter.count = 20;
  timer.jitter.max_ns = 50'000'000;
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

TEST(Finding, ThereIsNoneInAnEmptyTrace) {
  EXPECT_TRUE(find_worth_a_look({}).empty());
}

}  // namespace
}  // namespace tracing
