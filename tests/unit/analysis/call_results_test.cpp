// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using CallResults = testing::SummaryObjects;

TEST_F(CallResults, NameBothEnds) {
  const ros2::Gid gid{{1, 2, 3}, 16};
  model.on({0, 1, 1}, ros2::RmwClientInit{4, gid});
  model.on({0, 1, 1}, ros2::RclClientInit{3, 7, 4, "/add"});
  ServiceMatcher calls(model, nobody);
  calls.on({100, 1, 1}, ros2::RmwSendRequest{4, 9, 1});
  calls.on({110, 2, 2}, ros2::RmwTakeRequest{6, 9, gid, 1, true});  // of a service that is not in the trace
  calls.on({130, 1, 1}, ros2::RmwTakeResponse{4, 9, 1, 1, true});
  calls.on({140, 1, 1}, ros2::RmwSendRequest{99, 9, 1});
  calls.finish(140);
  const std::vector<CallResult> results = call_results(subjects, calls);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].service, "/add");
  EXPECT_EQ(results[0].client, "/node");
  EXPECT_EQ(results[0].client_process, 0u);
  EXPECT_EQ(results[0].server, "");
  EXPECT_EQ(results[0].server_process, std::nullopt);
  EXPECT_EQ(results[0].requests, 1u);
  EXPECT_EQ(results[0].responses, 1u);
  EXPECT_EQ(results[0].round_trip.max_ns, 30);
  EXPECT_EQ(results[0].request.max_ns, 10);
  EXPECT_EQ(calls.unknown_clients(), 1u);
}

}  // namespace
}  // namespace tracing
