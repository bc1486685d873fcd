// SPDX-License-Identifier: Apache-2.0
// Faults of services, as a test asks for them: which requests a service takes, and which responses clients get.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <utility>
#include <vector>

#include "fault_table.hpp"
#include "rmw_test.hpp"
#include "service_ends.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rmw_test::AddTwoInts;
using rmw_test::Asked;
using rmw_test::Client;
using rmw_test::Context;
using rmw_test::FaultTable;
using rmw_test::Kind;
using rmw_test::kPatience;
using rmw_test::Node;
using rmw_test::Service;
using rmw_test::Side;
using rmw_test::take_error;
using testing::ElementsAre;
using testing::Pair;

// Each test has services of its own.
const std::vector<Asked> kAsked = {
    {"/drop", Kind::kDrop, Side::kRequest, 2, 1, 1},
    {"/twice", Kind::kDuplicate, Side::kRequest, 2, 1, 1},
    {"/late", Kind::kDelay, Side::kRequest, 1, 1, 1, std::chrono::milliseconds(50)},
    {"/never", Kind::kDelay, Side::kRequest, 1, 1, 1, std::chrono::hours(1)},
    {"/late_of_gone", Kind::kDelay, Side::kRequest, 1, 1, 1, std::chrono::milliseconds(50)},
    {"/corrupt", Kind::kCorrupt, Side::kRequest, 2, 1, 1},
    {"/drop_response", Kind::kDrop, Side::kResponse, 2, 1, 1},
    {"/twice_response", Kind::kDuplicate, Side::kResponse, 2, 1, 1},
    {"/late_response", Kind::kDelay, Side::kResponse, 1, 1, 1, std::chrono::milliseconds(50)},
    {"/corrupt_response", Kind::kCorrupt, Side::kResponse, 2, 1, 1},
    {"/node", Kind::kDrop, Side::kRequest, 1, 1, 0, {}, "/server"},
    {"/other_node", Kind::kDrop, Side::kRequest, 1, 1, 0, {}, "/other"},
    {"/topic", Kind::kDrop, Side::kTake, 1, 1, 0},
};
const auto* const kTable = testing::AddGlobalTestEnvironment(new FaultTable(kAsked));

class ServiceFaultsTest : public testing::Test {
 protected:
  using Sums = std::vector<std::pair<std::int64_t, std::int64_t>>;  // sequence number of the request, sum

  // The first operands of the next requests, each of which is answered.
  static std::vector<std::int64_t> serve(Service& service, std::size_t expected) {
    std::vector<std::int64_t> taken;
    while (taken.size() < expected) {
      EXPECT_EQ(service.wait(kPatience), RMW_RET_OK) << "request " << taken.size() + 1 << " does not come";
      rmw_service_info_t info{};
      AddTwoInts::Request request;
      if (service.take(info, request)) {
        taken.push_back(request.a);
        EXPECT_EQ(service.respond(info, request.a + request.b), RMW_RET_OK) << take_error();
      } else if (HasFailure()) {
        break;
      }
    }
    return taken;
  }

  static Sums responses(Client& client, std::size_t expected) {
    Sums sums;
    while (sums.size() < expected) {
      EXPECT_EQ(client.wait(kPatience), RMW_RET_OK) << "response " << sums.size() + 1 << " does not come";
      rmw_service_info_t info{};
      AddTwoInts::Response response;
      if (client.take(info, response)) {
        sums.emplace_back(info.request_id.sequence_number, response.sum);
      } else if (HasFailure()) {
        break;
      }
    }
    return sums;
  }

  // Asks for 1 + 10, 2 + 10, …
  void ask(const char* name, std::int64_t requests, std::size_t taken, std::size_t answered) {
    Service service(server_, name);
    Client client(asker_, name);
    client.wait_for_service();
    for (std::int64_t i = 1; i <= requests; ++i) {
      EXPECT_EQ(client.send(i, 10), i);
    }
    taken_ = serve(service, taken);
    sums_ = responses(client, answered);
    rmw_service_info_t info{};
    AddTwoInts::Request request;
    EXPECT_FALSE(service.take(info, request)) << request.a;
    AddTwoInts::Response response;
    EXPECT_FALSE(client.take(info, response)) << response.sum;
  }

  test_support::Sandbox sandbox_;
  Context serving_context_;
  Context asking_context_;
  Node server_{serving_context_, "server"};
  Node asker_{asking_context_, "asker"};
  std::vector<std::int64_t> taken_;
  Sums sums_;
};

TEST_F(ServiceFaultsTest, DropsRequests) {
  ask("/drop", 3, 2, 2);
  EXPECT_THAT(taken_, ElementsAre(1, 3));
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(3, 13)));
  EXPECT_EQ(FaultTable::of("/drop").seen, 3U);
  EXPECT_EQ(FaultTable::of("/drop").hit, 1U);
}

TEST_F(ServiceFaultsTest, TakesRequestsTwice) {
  ask("/twice", 3, 4, 4);
  EXPECT_THAT(taken_, ElementsAre(1, 2, 2, 3));
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(2, 12), Pair(2, 12), Pair(3, 13)));
}

TEST_F(ServiceFaultsTest, TakesRequestsLate) {
  ask("/late", 2, 2, 2);
  EXPECT_THAT(taken_, ElementsAre(2, 1));
  EXPECT_THAT(sums_, ElementsAre(Pair(2, 12), Pair(1, 11)));
}

TEST_F(ServiceFaultsTest, ARequestThatIsLateEndsWithItsService) {
  ask("/never", 2, 1, 1);
  EXPECT_THAT(taken_, ElementsAre(2));
}

// As that of a client which ends while its request is served.
TEST_F(ServiceFaultsTest, ALateRequestOfAClientThatHasGoneIsServed) {
  Service service(server_, "/late_of_gone");
  {
    Client client(asker_, "/late_of_gone");
    client.wait_for_service();
    client.send(1, 10);
    rmw_service_info_t info{};
    AddTwoInts::Request request;
    while (FaultTable::of("/late_of_gone").seen == 0) {
      ASSERT_EQ(service.wait(kPatience), RMW_RET_OK);
      ASSERT_FALSE(service.take(info, request));
    }
  }
  EXPECT_THAT(serve(service, 1), ElementsAre(1));
}

TEST_F(ServiceFaultsTest, ChangesBytesOfRequests) {
  ask("/corrupt", 3, 3, 3);
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(2, testing::Ne(12)), Pair(3, 13)));
}

TEST_F(ServiceFaultsTest, DropsResponses) {
  ask("/drop_response", 3, 3, 2);
  EXPECT_THAT(taken_, ElementsAre(1, 2, 3));
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(3, 13)));
  EXPECT_EQ(FaultTable::of("/drop_response").hit, 1U);
}

TEST_F(ServiceFaultsTest, SendsResponsesTwice) {
  ask("/twice_response", 3, 3, 4);
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(2, 12), Pair(2, 12), Pair(3, 13)));
}

// In the layer the thread that has sent a late response waits with it.
TEST_F(ServiceFaultsTest, SendsResponsesLate) {
  ask("/late_response", 2, 2, 2);
  const Sums expected = {{2, 12}, {1, 11}};
  EXPECT_EQ(sums_, rmw_test::kIsLayer ? Sums(expected.rbegin(), expected.rend()) : expected);
}

TEST_F(ServiceFaultsTest, ChangesBytesOfResponses) {
  ask("/corrupt_response", 3, 3, 3);
  EXPECT_THAT(sums_, ElementsAre(Pair(1, 11), Pair(2, testing::Ne(12)), Pair(3, 13)));
}

TEST_F(ServiceFaultsTest, HitsTheServiceOfTheNodeThatItNamesOnly) {
  ask("/other_node", 2, 2, 2);
  EXPECT_EQ(FaultTable::of("/other_node").seen, 0U);
  Service service(server_, "/node");
  Client client(asker_, "/node");
  client.wait_for_service();
  client.send(1, 10);
  rmw_service_info_t info{};
  AddTwoInts::Request request;
  while (FaultTable::of("/node").seen == 0) {
    ASSERT_EQ(service.wait(kPatience), RMW_RET_OK);
    ASSERT_FALSE(service.take(info, request));
  }
}

TEST_F(ServiceFaultsTest, AFaultOfATopicIsNoneOfTheServiceOfThisName) {
  ask("/topic", 2, 2, 2);
  EXPECT_EQ(FaultTable::of("/topic").seen, 0U);
}

// Executors without a wait set are told of what waits behind the reader, too.
TEST_F(ServiceFaultsTest, TheCopyOfARequestIsAnnounced) {
  static std::atomic<std::size_t> announced;
  announced = 0;
  FaultTable::of("/twice").seen = 1;  // another test may have counted before
  Service service(server_, "/twice");
  Client client(asker_, "/twice");
  client.wait_for_service();
  ASSERT_EQ(rmw_service_set_on_new_request_callback(
                service.handle, [](const void*, std::size_t count) { announced += count; }, nullptr),
            RMW_RET_OK);
  client.send(1, 10);
  EXPECT_THAT(serve(service, 2), ElementsAre(1, 1));
  EXPECT_EQ(announced, 2U);
  ASSERT_EQ(rmw_service_set_on_new_request_callback(service.handle, nullptr, nullptr), RMW_RET_OK);
}

}  // namespace
