// SPDX-License-Identifier: Apache-2.0
// Conditions of the graph for the start of a process.
#include "launcher/ros/ros_readiness.hpp"

#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/ros/fake/fake_ros_client.hpp"

namespace {

using namespace launch;
using test_support::FakeRosClient;
using testing::ElementsAre;

TEST(RosReadiness, SaysWhatItWaitsFor) {
  const auto text = [](const RosRequest& condition) { return RosReadiness(nullptr, condition, {}).describe(); };
  EXPECT_EQ(text(NodePresent{"/n"}), "node '/n' is there");
  EXPECT_EQ(text(TopicPresent{"/t"}), "topic '/t' is published");
  EXPECT_EQ(text(ServicePresent{"/s"}), "service '/s' is offered");
  EXPECT_EQ(text(MessagePublished{"/t"}), "a message has come on '/t'");
  EXPECT_EQ(text(StateReached{"/n", "active"}), "'/n' is active");
  EXPECT_EQ(text(ParameterReached{"/n", {"p", ParameterScalar(true)}}), "parameter 'p' of '/n' is True");
}

TEST(RosReadiness, KnowsWhatIsThereInstead) {
  FakeEventLoop loop;
  FakeRosClient client(loop);
  RosReadiness ready(&client, StateReached{"/n", "active"}, {});
  ready.watch(loop, [](const std::optional<std::string>&) { FAIL(); });
  EXPECT_EQ(ready.seen(), "");
  RosAnswer answer;
  answer.seen = "inactive";
  EXPECT_TRUE(client.answer_pending("'/n' to be active", answer));
  EXPECT_EQ(ready.seen(), "inactive");
}

TEST(RosReadiness, HoldsWhenTheClientSaysSo) {
  FakeEventLoop loop;
  FakeRosClient client(loop);
  std::vector<std::optional<std::string>> told;
  RosReadiness ready(&client, TopicPresent{"/t"}, {});
  ready.watch(loop, [&](const std::optional<std::string>& failure) { told.push_back(failure); });
  EXPECT_THAT(client.asked, ElementsAre("a publisher of '/t'"));
  EXPECT_TRUE(client.answer_pending("a publisher of '/t'", FakeRosClient::loaded("")));
  EXPECT_THAT(told, ElementsAre(std::nullopt));

  RosReadiness failed(&client, TopicPresent{"/t"}, {});
  failed.watch(loop, [&](const std::optional<std::string>& failure) { told.push_back(failure); });
  EXPECT_TRUE(client.answer_pending("a publisher of '/t'", FakeRosClient::refused("launch-ros-client has ended")));
  EXPECT_THAT(told, ElementsAre(std::nullopt, "launch-ros-client has ended"));
}

TEST(RosReadiness, IsNotAnsweredOnceItIsGivenUp) {
  FakeEventLoop loop;
  FakeRosClient client(loop);
  {
    RosReadiness given_up(&client, TopicPresent{"/t"}, {});
    given_up.watch(loop, [](const std::optional<std::string>&) { FAIL(); });
  }
  EXPECT_FALSE(client.answer_pending("a publisher of '/t'", FakeRosClient::loaded("")));
}

}  // namespace
