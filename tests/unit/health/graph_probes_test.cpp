// SPDX-License-Identifier: Apache-2.0
// What watches of the ROS graph make of the answers of launch-ros-client.
#include <gmock/gmock.h>

#include "launcher/health/answer_probe.hpp"
#include "launcher/health/topic_probe.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/ros/fake/fake_ros_client.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using test_support::FakeRosClient;
using testing::IsEmpty;
using testing::SizeIs;

class GraphProbes : public testing::Test {
 protected:
  // Answers of a second, and a look at its end.
  Look look_after(HealthProbe& probe, const std::string& text, const RosAnswer& answer, Duration passed = 1s) {
    client_.tell(text, answer);
    return probe.look(now_ += 1s, passed);
  }
  static RosAnswer traffic(std::uint64_t messages, Duration measured = 1s, std::uint64_t publishers = 1) {
    RosAnswer answer;
    answer.ok = true;
    answer.traffic = TopicTraffic{messages, publishers, measured};
    return answer;
  }
  static RosAnswer finding(ServiceFinding found, const std::string& state = {}) {
    RosAnswer answer;
    answer.ok = true;
    answer.found = found;
    answer.state = state;
    return answer;
  }
  GraphWatch watch(RosRequest request) { return GraphWatch(&client_, std::move(request), {}); }
  ProcessorWait wait_ = ProcessorWait("/no such directory");

  FakeEventLoop loop_;
  FakeRosClient client_{loop_};
  Duration now_ = 100s;
};

class TopicProbeTest : public GraphProbes {
 protected:
  TopicProbeTest() { begin(); }
  void begin() {
    probe_.begin(1);
    probe_.look(now_, 0s);
  }
  Look look(std::uint64_t messages, Duration passed = 1s, Duration measured = 1s) {
    return look_after(probe_, "the rate of '/scan'", traffic(messages, measured), passed);
  }
  TopicProbe probe_{watch(MeterTopic{"/scan", 1s}), {.topic = "/scan", .min_rate = 5}, 3s, wait_};
};

TEST_F(TopicProbeTest, WantsTheRateOverTheTimeOut) {
  EXPECT_EQ(look(5).result, Look::Result::kPending);
  EXPECT_EQ(look(5).result, Look::Result::kPending);
  EXPECT_EQ(look(5).result, Look::Result::kGood);
  EXPECT_EQ(look(4).result, Look::Result::kGood) << "one message may be late";
  EXPECT_EQ(look(4).why, "'/scan' has had 4.3 messages a second in the last 3.0 s, not 5.0");
  look(7);
  EXPECT_EQ(look(5).result, Look::Result::kGood);
}

TEST_F(TopicProbeTest, FindsSilenceWithinTheTimeOut) {
  look(5);
  look(5);
  EXPECT_EQ(look(5).result, Look::Result::kGood);
  EXPECT_EQ(look(0).result, Look::Result::kBad) << "too few in the last three seconds";
  look(0);
  EXPECT_EQ(look(0).why, "no message has come on '/scan' for 3.0 s");
}

TEST_F(TopicProbeTest, ATimeInWhichNobodyLookedIsNoSilence) {
  look(5);
  look(5);
  look(5);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(look(0, 0s).result, Look::Result::kGood) << "the launcher was stopped";
    EXPECT_EQ(look(0, 1s, 0s).result, Look::Result::kGood) << "launch-ros-client got no processor";
  }
}

TEST_F(TopicProbeTest, SaysThatThereIsNoPublisher) {
  Look last;
  for (int i = 0; i < 3; ++i) {
    last = look_after(probe_, "the rate of '/scan'", traffic(0, 1s, 0));
  }
  EXPECT_EQ(last.why, "no message has come on '/scan' for 3.0 s (it has no publisher)");
}

TEST_F(TopicProbeTest, TheEndOfTheClientIsNoSilence) {
  client_.answer_pending("the rate of '/scan'", FakeRosClient::refused("launch-ros-client was ended by SIGKILL"));
  const Look look = probe_.look(now_ += 1s, 1s);
  EXPECT_EQ(look.result, Look::Result::kPending);
  EXPECT_EQ(look.note, "whether '/scan' is published can't be watched: launch-ros-client was ended by SIGKILL");
  EXPECT_THAT(client_.asked, SizeIs(1)) << "not at once again";
  probe_.look(now_ += 5s, 1s);
  EXPECT_THAT(client_.asked, SizeIs(2));
}

TEST_F(TopicProbeTest, OneMessageInTheTimeOutIsEnoughWithoutARate) {
  TopicProbe probe(watch(MeterTopic{"/map", 1s}), {.topic = "/map"}, 3s, wait_);
  probe.begin(1);
  probe.look(now_, 0s);
  EXPECT_EQ(look_after(probe, "the rate of '/map'", traffic(1)).result, Look::Result::kGood);
  EXPECT_EQ(look_after(probe, "the rate of '/map'", traffic(0)).result, Look::Result::kGood);
  EXPECT_EQ(look_after(probe, "the rate of '/map'", traffic(0)).result, Look::Result::kGood);
  EXPECT_EQ(look_after(probe, "the rate of '/map'", traffic(0)).result, Look::Result::kBad);
}

class AnswerProbeTest : public GraphProbes {
 protected:
  AnswerProbeTest() {
    probe_.begin(1);
    probe_.look(now_, 0s);
  }
  Look look(ServiceFinding found, const std::string& state = {}) {
    return look_after(probe_, "answers of '/n/get_state'", finding(found, state));
  }
  AnswerProbe probe_{watch(AskState{"/n", 1s}), "/n/get_state", "active", 3s, wait_};
};

TEST_F(AnswerProbeTest, WantsTheStateWithinTheTimeOut) {
  look(ServiceFinding::kFound, "inactive");
  EXPECT_EQ(look(ServiceFinding::kFound, "inactive").result, Look::Result::kPending);
  EXPECT_EQ(look(ServiceFinding::kFound, "inactive").why,
            "it has not been active for 3.0 s: '/n/get_state' says inactive");
  EXPECT_EQ(look(ServiceFinding::kFound, "active").result, Look::Result::kGood);
  EXPECT_EQ(probe_.look(now_ += 10s, 10s).result, Look::Result::kGood) << "nothing else was told";
}

TEST_F(AnswerProbeTest, WantsAnAnswerWithinTheTimeOut) {
  look(ServiceFinding::kFound, "active");
  look(ServiceFinding::kAsked, "active");
  EXPECT_EQ(look(ServiceFinding::kAsked, "active").result, Look::Result::kPending);
  EXPECT_EQ(look(ServiceFinding::kAsked, "active").why, "the service '/n/get_state' has not answered for 3.0 s");
}

TEST_F(AnswerProbeTest, AClientThatGetsNoProcessorWaitsInVainForNoAnswer) {
  look(ServiceFinding::kAsked);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(probe_.look(now_ += 1s, 1s).result, Look::Result::kPending);
  }
}

TEST_F(AnswerProbeTest, WantsTheServiceToBeThere) {
  look(ServiceFinding::kFound, "active");
  look(ServiceFinding::kGone);
  look(ServiceFinding::kGone);
  EXPECT_EQ(look(ServiceFinding::kGone).why, "there has been no service '/n/get_state' for 3.0 s");
}

TEST_F(AnswerProbeTest, SaysThatThereIsNoClient) {
  AnswerProbe probe(GraphWatch(nullptr, AskState{"/n", 1s}, {}), "/n/get_state", "active", 3s, wait_);
  probe.begin(1);
  EXPECT_EQ(probe.look(now_, 1s).note, "whether '/n/get_state' answers can't be watched: there is no ROS client");
}

}  // namespace
}  // namespace launch
