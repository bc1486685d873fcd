// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/derived_results.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

CallResult call(const std::string& service, std::uint64_t requests, std::uint64_t responses, std::int64_t took_ns) {
  CallResult result;
  result.service = service;
  result.client = "/client";
  result.client_process = 0;
  result.server = "/server";
  result.server_process = 1;
  result.requests = requests;
  result.responses = responses;
  result.round_trip.count = responses;
  result.round_trip.max_ns = took_ns;
  return result;
}

TEST(ActionResults, AreMadeOfTheServicesOfAnAction) {
  Ros2Results results;
  results.calls = {call("/add", 9, 9, 1), call("/ns/fly/_action/cancel_goal", 1, 1, 2),
                   call("/ns/fly/_action/get_result", 3, 2, 30), call("/ns/fly/_action/send_goal", 4, 4, 3)};
  TopicResult feedback;
  feedback.name = "/ns/fly/_action/feedback";
  feedback.published = 20;
  results.topics = {feedback};
  const std::vector<ActionResult> actions = action_results(results);
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_EQ(actions[0].name, "/ns/fly");
  EXPECT_EQ(actions[0].client, "/client");
  EXPECT_EQ(actions[0].server, "/server");
  EXPECT_EQ(actions[0].goals, 4u);
  EXPECT_EQ(actions[0].answers, 4u);
  EXPECT_EQ(actions[0].results, 2u);
  EXPECT_EQ(actions[0].cancels, 1u);
  EXPECT_EQ(actions[0].feedback, 20u);
  EXPECT_EQ(actions[0].acceptance.max_ns, 3);
  EXPECT_EQ(actions[0].execution.max_ns, 30);
}

}  // namespace
}  // namespace tracing
