// SPDX-License-Identifier: Apache-2.0
// Calls of services: requests, responses, and the work of executors and clients with them.
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;
using Kind = ros2::ExecutionEvent::Kind;
using Owner = CallbackResult::Owner;

constexpr ProcessId kClient = 71;
constexpr ProcessId kServer = 72;
const ros2::Gid kGid{{1, 2, 3}, 16};

// The client's process has node /asker with client 3 (rmw 4). The server's has /adder with service 5 (rmw 6), callback
// 7.
Feed with_client_and_service() {
  Feed feed;
  feed.in(kClient, kClient)(ros2::RclNodeInit{1, 2, "asker", "/"});
  feed(ros2::RmwClientInit{4, kGid})(ros2::RclClientInit{3, 1, 4, "/add"});
  feed.in(kServer, kServer)(ros2::RclNodeInit{1, 2, "adder", "/"});
  feed(ros2::RclServiceInit{5, 1, 6, "/add"})(ros2::RclcppServiceCallbackAdded{5, 7});
  return feed;
}

// Each step takes 10 ns: send, take, callback, its end, send, take.
void call(Feed& feed, std::int64_t number) {
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, number});
  feed.in(kServer, kServer)(ros2::RmwTakeRequest{6, 9, kGid, number, true});
  feed(ros2::CallbackStart{7, false})(ros2::CallbackEnd{7})(ros2::RmwSendResponse{6, 9, kGid, number, 1});
  feed.in(kClient, kClient)(ros2::RmwTakeResponse{4, 9, number, 1, true});
}

TEST(ServiceCalls, TellWhoAskedWhomAndHowLongEachPartTook) {
  Feed feed = with_client_and_service();
  call(feed, 1);
  call(feed, 2);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  const CallResult& asked = results.calls[0];
  EXPECT_EQ(asked.service, "/add");
  EXPECT_EQ(asked.client, "/asker");
  EXPECT_EQ(asked.client_process, kClient);
  EXPECT_EQ(asked.server, "/adder");
  EXPECT_EQ(asked.server_process, kServer);
  EXPECT_EQ(asked.requests, 2u);
  EXPECT_EQ(asked.responses, 2u);
  EXPECT_EQ(asked.round_trip.count, 2u);
  EXPECT_EQ(asked.round_trip.max_ns, 50);
  EXPECT_EQ(asked.request.max_ns, 10);
  EXPECT_EQ(asked.in_service.max_ns, 30);
  EXPECT_EQ(asked.response.max_ns, 10);
  EXPECT_TRUE(results.executions.empty());
}

// The client records a request after it has sent it.
TEST(ServiceCalls, FollowsARequestThatIsTakenOrAnsweredBeforeTheClientTellsOfIt) {
  Feed feed = with_client_and_service();
  feed.in(kServer, kServer)(ros2::RmwTakeRequest{6, 9, kGid, 1, true});
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 1});
  feed.in(kServer, kServer)(ros2::RmwSendResponse{6, 9, kGid, 1, 1})(ros2::RmwTakeRequest{6, 9, kGid, 2, true});
  feed.in(kClient, kClient)(ros2::RmwTakeResponse{4, 9, 1, 1, true});
  feed.in(kServer, kServer)(ros2::RmwSendResponse{6, 9, kGid, 2, 1});
  feed.in(kClient, kClient + 1)(ros2::RmwTakeResponse{4, 9, 2, 1, true});
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 2});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].client, "/asker");
  EXPECT_EQ(results.calls[0].server, "/adder");
  EXPECT_EQ(results.calls[0].requests, 2u);
  EXPECT_EQ(results.calls[0].responses, 2u);
  EXPECT_EQ(results.calls[0].round_trip.max_ns, 30);
  EXPECT_EQ(results.calls[0].round_trip.min_ns, 0);
  EXPECT_EQ(results.calls[0].request.max_ns, 0);
  EXPECT_EQ(results.calls[0].in_service.count, 2u);
}

TEST(ServiceCalls, KeepsClientsOfOneServiceApartByTheirGids) {
  Feed feed = with_client_and_service();
  const ros2::Gid other{{9}, 16};
  feed.in(73, 73)(ros2::RclNodeInit{1, 2, "other", "/"});
  feed(ros2::RmwClientInit{4, other})(ros2::RclClientInit{3, 1, 4, "/add"})(ros2::RmwSendRequest{4, 9, 1});
  call(feed, 1);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 2u);
  EXPECT_EQ(results.calls[0].client, "/asker");
  EXPECT_EQ(results.calls[0].responses, 1u);
  EXPECT_EQ(results.calls[1].client, "/other");
  EXPECT_EQ(results.calls[1].requests, 1u);
  EXPECT_EQ(results.calls[1].responses, 0u);
  EXPECT_EQ(results.calls[1].server, "") << "no service has taken it";
  EXPECT_EQ(results.calls[1].server_process, std::nullopt);
}

TEST(ServiceCalls, CountsARequestWithoutAResponse) {
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 1})(ros2::RmwTakeResponse{4, 9, 1, 0, false});
  feed.in(kServer, kServer)(ros2::RmwTakeRequest{6, 9, kGid, 1, false})(ros2::RmwTakeRequest{6, 9, kGid, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].server, "/adder");
  EXPECT_EQ(results.calls[0].requests, 1u);
  EXPECT_EQ(results.calls[0].responses, 0u);
  EXPECT_EQ(results.calls[0].request.max_ns, 30);
  EXPECT_EQ(results.calls[0].round_trip.count, 0u);
}

constexpr std::int64_t kMillisecond = 1'000'000;

// The results of a call that is answered, and of a request that is sent at 1 s and gets no response.
CallResult with_open_request(const std::function<void(Feed&)>& then, std::int64_t end_ns) {
  Feed feed = with_client_and_service();
  call(feed, 1);
  feed.at(1000 * kMillisecond).in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 2});
  then(feed);
  feed.at(end_ns).in(kClient, kClient + 1)(ros2::RclcppExecutorGetNextReady{});
  CallResult both;
  for (const CallResult& result : feed.results().calls) {  // one that is not taken has no service
    both.requests += result.requests;
    both.responses += result.responses;
    both.in_flight += result.in_flight;
  }
  EXPECT_EQ(both.requests, 2u);
  EXPECT_EQ(both.responses, 1u);
  return both;
}

TEST(ServiceCalls, ARequestShortlyBeforeTheEndIsInFlight) {
  const auto nothing = [](Feed&) {};
  EXPECT_EQ(with_open_request(nothing, 1009 * kMillisecond).in_flight, 1u);
  const CallResult late = with_open_request(nothing, 1011 * kMillisecond);
  EXPECT_EQ(late.in_flight, 0u);
  EXPECT_EQ(late.unanswered(), 1u);
}

TEST(ServiceCalls, ARequestIsInFlightAsLongAsTheSlowestAnswerOfItsClientTook) {
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 1});
  feed.at(300 * kMillisecond)(ros2::RmwTakeResponse{4, 9, 1, 1, true});
  feed.at(1000 * kMillisecond)(ros2::RmwSendRequest{4, 9, 2}).at(1100 * kMillisecond)(ros2::RmwSendRequest{4, 9, 3});
  feed.at(1350 * kMillisecond)(ros2::RclcppExecutorGetNextReady{});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].in_flight, 1u);
  EXPECT_EQ(results.calls[0].unanswered(), 1u);
}

TEST(ServiceCalls, ARequestIsInFlightWhileItsServiceWorks) {
  const auto take = [](Feed& feed) { feed.in(kServer, kServer)(ros2::RmwTakeRequest{6, 9, kGid, 2, true}); };
  const auto works = [&](Feed& feed) {
    take(feed);
    feed(ros2::CallbackStart{7, false});
  };
  const auto worked = [&](Feed& feed) {
    works(feed);
    feed(ros2::CallbackEnd{7});
  };
  constexpr std::int64_t kEnd = 60'000 * kMillisecond;
  EXPECT_EQ(with_open_request(works, kEnd).in_flight, 1u);
  EXPECT_EQ(with_open_request(worked, kEnd).in_flight, 0u) << "it has forgotten the request";
  EXPECT_EQ(with_open_request(take, kEnd).in_flight, 0u);
  const auto dies = [&](Feed& feed) {
    works(feed);
    feed.ends_process(kServer);
  };
  EXPECT_EQ(with_open_request(dies, kEnd).in_flight, 0u) << "nobody works at it any more";
}

TEST(ServiceCalls, AClientThatHasEndedWaitsNoLonger) {
  constexpr std::int64_t kEnd = 60'000 * kMillisecond;
  using End = ros2::ObjectEnd::Kind;
  const auto client_ends = [](Feed& feed) {
    feed.at(1005 * kMillisecond).end(End::kRclClient, 3).end(End::kRmwClient, 4);
  };
  EXPECT_EQ(with_open_request(client_ends, kEnd).in_flight, 1u);
  const auto process_ends = [](Feed& feed) { feed.at(1005 * kMillisecond).ends_process(kClient); };
  EXPECT_EQ(with_open_request(process_ends, kEnd).in_flight, 1u);
  const auto ends_later = [](Feed& feed) { feed.at(2000 * kMillisecond).ends_process(kClient); };
  EXPECT_EQ(with_open_request(ends_later, kEnd).in_flight, 0u);
}

TEST(ServiceCalls, KnowsTheServersPartOfAClientOutsideTheTrace) {
  Feed feed = with_client_and_service();
  const ros2::Gid outside{{7}, 16};
  feed.in(kServer, kServer)(ros2::RmwTakeRequest{6, 9, outside, 1, true})(ros2::RmwSendResponse{6, 9, outside, 1, 1});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].service, "/add");
  EXPECT_EQ(results.calls[0].client, "");
  EXPECT_EQ(results.calls[0].client_process, std::nullopt);
  EXPECT_EQ(results.calls[0].responses, 1u);
  EXPECT_EQ(results.calls[0].in_service.max_ns, 10);
  EXPECT_EQ(results.calls[0].round_trip.count, 0u);
}

TEST(ServiceCalls, KnowsTheRoundTripOfAServiceOutsideTheTrace) {
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 1})(ros2::RmwTakeResponse{4, 9, 1, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].service, "/add");
  EXPECT_EQ(results.calls[0].server_process, std::nullopt);
  EXPECT_EQ(results.calls[0].responses, 1u);
  EXPECT_EQ(results.calls[0].round_trip.max_ns, 10);
}

TEST(ServiceCalls, FindsResponsesOfAClientWithoutAnIdentity) {
  Feed feed;
  feed.in(kClient, kClient)(ros2::RclClientInit{3, 1, 4, "/add"})(ros2::RclClientInit{13, 1, 14, "/add"});
  feed(ros2::RmwSendRequest{4, 9, 1})(ros2::RmwSendRequest{14, 9, 1});
  feed(ros2::RmwTakeResponse{4, 9, 1, 1, true})(ros2::RmwTakeResponse{14, 9, 1, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 2u);
  EXPECT_EQ(results.calls[0].round_trip.max_ns, 20);
  EXPECT_EQ(results.calls[1].round_trip.max_ns, 20);
}

TEST(ServiceCalls, ForgetsTheOldestOfVeryManyWithoutAResponse) {
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient);
  for (std::int64_t number = 0; number <= static_cast<std::int64_t>(ServiceMatcher::kRemembered); ++number) {
    feed(ros2::RmwSendRequest{4, 9, number});
  }
  feed(ros2::RmwTakeResponse{4, 9, 0, 1, true})(ros2::RmwTakeResponse{4, 9, 1, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].requests, ServiceMatcher::kRemembered + 1);
  EXPECT_EQ(results.calls[0].responses, 1u);
}

TEST(ServiceCalls, AClientOfAnEndedOnesHandlesIsAnother) {
  using End = ros2::ObjectEnd::Kind;
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient).end(End::kRclClient, 3).end(End::kRmwClient, 4)(ros2::RmwSendRequest{4, 9, 1});
  feed(ros2::RmwClientInit{4, {{5}, 16}})(ros2::RclClientInit{3, 1, 4, "/subtract"})(ros2::RmwSendRequest{4, 9, 1});
  feed.in(kServer, kServer).end(End::kRclService, 5).end(End::kRmwService, 6);
  feed(ros2::RmwTakeRequest{6, 9, {{5}, 16}, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].service, "/subtract");
  EXPECT_EQ(results.calls[0].server_process, std::nullopt);
}

TEST(ServiceCalls, AClientToldAgainIsTheSame) {
  Feed feed = with_client_and_service();
  feed.in(kClient, kClient)(ros2::RmwSendRequest{4, 9, 1});
  feed(ros2::RmwClientInit{4, kGid})(ros2::RclClientInit{3, 1, 4, "/add"});
  feed(ros2::RmwTakeResponse{4, 9, 1, 1, true})(ros2::RmwSendRequest{4, 9, 2});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.calls.size(), 1u);
  EXPECT_EQ(results.calls[0].requests, 2u);
  EXPECT_EQ(results.calls[0].responses, 1u);
}

TEST(Executions, OfServicesAndClientsEndWithTheResponse) {
  Feed feed = with_client_and_service();
  feed.in(kServer, kServer)(ros2::RclcppExecutorGetNextReady{}).executes(Kind::kService, 5);
  feed(ros2::RmwTakeRequest{6, 9, kGid, 1, true})(ros2::RmwSendResponse{6, 9, kGid, 1, 1});
  feed(ros2::RmwSendResponse{6, 9, kGid, 2, 1});  // response to an earlier request, without an execution
  feed.in(kClient, kClient).executes(Kind::kClient, 3)(ros2::RmwTakeResponse{4, 9, 1, 1, true});
  feed.executes(Kind::kClientCallbackStart, 3).executes(Kind::kClientCallbackEnd, 3);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executions.size(), 2u);
  EXPECT_EQ(results.executions[0].kind, ExecutionResult::Kind::kClient);
  EXPECT_EQ(results.executions[0].node, "/asker");
  EXPECT_EQ(results.executions[0].service, "/add");
  EXPECT_EQ(results.executions[0].durations.max_ns, 30);
  EXPECT_EQ(results.executions[1].kind, ExecutionResult::Kind::kService);
  EXPECT_EQ(results.executions[1].node, "/adder");
  EXPECT_EQ(results.executions[1].count, 1u);
  EXPECT_EQ(results.executions[1].durations.count, 1u);
  EXPECT_EQ(results.executions[1].durations.max_ns, 20);

  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].owner, Owner::kClient);
  EXPECT_EQ(results.callbacks[0].owner_name, "/add");
  EXPECT_EQ(results.callbacks[0].node, "/asker");
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 10);
}

TEST(Executions, OfWaitablesAreCounted) {
  Feed feed;
  feed.executes(Kind::kWaitable, 8).executes(Kind::kWaitable, 8)(ros2::RclcppExecutorWaitForWork{0});
  feed.executes(Kind::kService, 5)(ros2::RclcppExecutorGetNextReady{})(ros2::RmwSendResponse{6, 9, kGid, 1, 1});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executions.size(), 2u);
  EXPECT_EQ(results.executions[0].kind, ExecutionResult::Kind::kService);
  EXPECT_EQ(results.executions[0].address, 5u) << "its initialisation is not in the trace";
  EXPECT_EQ(results.executions[0].count, 1u);
  EXPECT_EQ(results.executions[0].durations.count, 0u) << "what was sent later was not its response";
  EXPECT_EQ(results.executions[1].kind, ExecutionResult::Kind::kWaitable);
  EXPECT_EQ(results.executions[1].address, 8u);
  EXPECT_EQ(results.executions[1].count, 2u);
  EXPECT_EQ(results.executions[1].durations.count, 0u);
}

}  // namespace
}  // namespace tracing
