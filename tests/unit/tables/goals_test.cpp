// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/tables/goals.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

using timeline::Call;
using timeline::kNone;

class Goals : public ::testing::Test {
 protected:
  Goals() {
    timeline_.clients = {{7, "/fly/_action/send_goal"}, {7, "/fly/_action/get_result"}, {7, "/other"}};
    timeline_.services = {{3, "/fly/_action/send_goal"}, {3, "/fly/_action/get_result"}};
  }
  void call(timeline::Index client, std::int64_t sent_ns, std::int64_t received_ns) {
    timeline_.details.calls.push_back({client, client, sent_ns, sent_ns + 1, received_ns - 1, received_ns});
  }
  timeline::Timeline timeline_;
};

TEST_F(Goals, HaveTheResultThatIsAskedForAfterTheirAnswer) {
  call(0, 100, 120);
  call(1, 125, 500);
  call(0, 130, 150);
  call(1, 155, 400);
  const std::vector<Goal> goals = goals_of(timeline_);
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_EQ(goals[0].action, "/fly");
  EXPECT_EQ(goals[0].client, 7u);
  EXPECT_EQ(goals[0].server, 3u);
  EXPECT_EQ(goals[0].answered_ns, 120);
  EXPECT_EQ(goals[0].asked_ns, 125);
  EXPECT_EQ(goals[0].result_ns, 500);
  EXPECT_EQ(goals[1].result_call, 3u);
  EXPECT_EQ(goals[1].result_ns, 400);
}

TEST_F(Goals, ThatAreRejectedHaveNoResult) {
  call(0, 100, 120);
  call(0, 130, 150);
  call(1, 155, 400);
  const std::vector<Goal> goals = goals_of(timeline_);
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_EQ(goals[0].result_call, kNone);
  EXPECT_EQ(goals[1].asked_ns, 155);
}

TEST_F(Goals, AreNotAllCalls) {
  call(2, 100, 120);
  EXPECT_TRUE(goals_of(timeline_).empty());
}

}  // namespace
}  // namespace tracing
