// SPDX-License-Identifier: Apache-2.0
// Lines between the launcher and launch-ros-client.
#include "launcher/ros/ros_protocol.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace launch;
using namespace std::chrono_literals;
using Scalars = std::vector<ParameterScalar>;

TEST(RosProtocol, ARequestIsOneLine) {
  ComposableNode node;
  node.package = "demo";
  node.plugin = "demo::Talker";
  node.name = "talker";
  node.name_space = "/left";
  node.parameters = {{"rate", ParameterScalar(2.0)}, {"text", ParameterScalar(std::string("a\n\"b\""))}};
  node.remaps = {{"chatter", "/out"}};
  EXPECT_EQ(to_line(RosRequestLine{7, LoadNode{"/c", node}, 1500ms}),
            R"({"id":7,"do":"load_node","container":"/c","node":{"package":"demo","plugin":"demo::Talker",)"
            R"("name":"talker","namespace":"/left","parameters":[{"name":"rate","value":2.0},)"
            R"({"name":"text","value":"a\n\"b\""}],"remaps":[["chatter","/out"]],"extra_arguments":[]},"timeout":1.5})"
            "\n");
  EXPECT_EQ(to_line(RosRequestLine{8, std::nullopt, 0s}), "{\"id\":8,\"do\":\"cancel\"}\n");
}

TEST(RosProtocol, ValuesOfParametersKeepTheirTypes) {
  ComposableNode node;
  const std::vector<ParameterValue> values = {
      ParameterScalar(true),
      ParameterScalar(std::numeric_limits<std::int64_t>::min()),
      ParameterScalar(3.0),
      ParameterScalar(1e300),
      ParameterScalar(-std::numeric_limits<double>::infinity()),
      ParameterScalar(std::string("1")),
      Scalars{},
      Scalars{1.0, 2.5, std::numeric_limits<double>::infinity()},
      Scalars{std::int64_t(1), std::int64_t(-2)},
      Scalars{std::string("x"), std::string()},
      Scalars{std::byte{0}, std::byte{255}},
  };
  for (const ParameterValue& value : values) {
    node.parameters.push_back({"p", value});
  }
  const RosRequestLine line = parse_request_line(to_line(RosRequestLine{1, LoadNode{"/c", node}, 0s}));
  const auto& read = std::get<LoadNode>(*line.request).node.parameters;
  ASSERT_EQ(read.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(read[i].value, values[i]) << i;
  }

  node.parameters = {{"p", ParameterScalar(std::nan(""))}};
  const RosRequestLine again = parse_request_line(to_line(RosRequestLine{1, LoadNode{"/c", node}, 0s}));
  const auto& value = std::get<ParameterScalar>(std::get<LoadNode>(*again.request).node.parameters[0].value);
  EXPECT_TRUE(std::isnan(std::get<double>(value)));
}

TEST(RosProtocol, EveryKindOfRequestComesBack) {
  const std::vector<RosRequest> requests = {
      UnloadNode{"/c", 3},
      ListNodes{"/c"},
      ChangeState{"/n", "configure"},
      GetState{"/n"},
      SetParameters{"/n", {{"p", Scalars{1.5}}, {"q", ParameterScalar(true)}}},
      NodePresent{"/n"},
      TopicPresent{"/t"},
      ServicePresent{"/s"},
      MessagePublished{"/t"},
      StateReached{"/n", "active"},
      WatchTransitions{"/n"},
      ParameterReached{"/n", {"p", Scalars{1.5}}},
      WatchMessages{"/t", "std_msgs/msg/String", "data == 'a'"},
  };
  for (const RosRequest& request : requests) {
    const std::string line = to_line(RosRequestLine{9, request, 2s});
    const RosRequestLine read = parse_request_line(line);
    EXPECT_EQ(read.request->index(), request.index());
    EXPECT_EQ(read.timeout, 2s);
    EXPECT_EQ(to_line(read), line);
  }
}

TEST(RosProtocol, AnswersSayOnlyWhatTheyHold) {
  RosAnswer answer;
  answer.ok = true;
  answer.nodes = {"/a", "/b"};
  answer.ids = {1, 2};
  const std::string line = to_line(RosAnswerLine{4, answer});
  EXPECT_EQ(line, "{\"id\":4,\"ok\":true,\"nodes\":[\"/a\",\"/b\"],\"ids\":[1,2]}\n");
  const RosAnswerLine read = parse_answer_line(line);
  EXPECT_EQ(read.id, 4U);
  EXPECT_TRUE(read.answer.ok);
  EXPECT_EQ(read.answer.nodes, answer.nodes);
  EXPECT_EQ(read.answer.ids, answer.ids);
}

TEST(RosProtocol, WhatHasBeenSeenComesBack) {
  RosAnswer answer;
  answer.seen = "it is 3";
  answer.messages = launch::SeenMessages{5, 2, 10, 20, {"{data: 1}"}, 1, {"std_msgs/msg/Int64"}};
  const std::string line = to_line(RosAnswerLine{4, answer});
  EXPECT_EQ(line,
            "{\"id\":4,\"ok\":false,\"seen\":\"it is 3\",\"messages\":{\"all\":5,\"matching\":2,\"first_ns\":10,"
            "\"last_ns\":20,\"last\":[\"{data: 1}\"],\"publishers\":1,\"types\":[\"std_msgs/msg/Int64\"]}}\n");
  EXPECT_EQ(to_line(parse_answer_line(line)), line);
}

TEST(RosProtocol, WhatIsNoLineIsAnError) {
  EXPECT_THROW(parse_request_line("{"), std::runtime_error);
  EXPECT_THROW(parse_request_line(R"({"id":1,"do":"dance"})"), std::runtime_error);
  EXPECT_THROW(parse_request_line(R"({"id":1,"do":"get_state"})"), std::runtime_error);
  EXPECT_THROW(parse_answer_line(R"({"id":1})"), std::runtime_error);
}

TEST(RosProtocol, WatchesOfHealthAndTheirAnswersSurviveTheWay) {
  const auto meter = parse_request_line(to_line(RosRequestLine{1, MeterTopic{"/scan", 200ms}, 0s}));
  EXPECT_EQ(std::get<MeterTopic>(*meter.request).topic, "/scan");
  EXPECT_EQ(std::get<MeterTopic>(*meter.request).every, Duration(200ms));
  const auto service = parse_request_line(to_line(RosRequestLine{1, AskService{"/map/load", 5s}, 0s}));
  EXPECT_EQ(std::get<AskService>(*service.request).service, "/map/load");
  const auto state = parse_request_line(to_line(RosRequestLine{1, AskState{"/driver", 5s}, 0s}));
  EXPECT_EQ(std::get<AskState>(*state.request).node, "/driver");

  RosAnswer answer;
  answer.ok = true;
  answer.traffic = TopicTraffic{7, 2, 150ms};
  answer.found = ServiceFinding::kAsked;
  const RosAnswer read = parse_answer_line(to_line(RosAnswerLine{3, answer})).answer;
  ASSERT_TRUE(read.traffic);
  EXPECT_EQ(read.traffic->messages, 7U);
  EXPECT_EQ(read.traffic->publishers, 2U);
  EXPECT_EQ(read.traffic->measured, Duration(150ms));
  EXPECT_EQ(read.found, ServiceFinding::kAsked);
  EXPECT_FALSE(parse_answer_line(to_line(RosAnswerLine{3, {}})).answer.traffic);
}

}  // namespace
