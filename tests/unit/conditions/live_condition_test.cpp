// SPDX-License-Identifier: Apache-2.0
// Conditions on what nodes do: their texts, and the messages about them.
#include "tracing/model/conditions/live_condition.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tracing/model/conditions/condition_lines.hpp"

namespace tracing {
namespace {

using namespace std::chrono_literals;
using Subject = LiveCondition::Subject;

const LiveCondition kSilentTopic{.name = "/scan", .window = 2s};
const LiveCondition kSilentNode{.subject = Subject::kNode, .name = "/planner", .window = 500ms};
const LiveCondition kSlow{.kind = LiveCondition::Kind::kRate, .name = "/scan", .window = 2s, .below = 5};
const LiveCondition kFast{.kind = LiveCondition::Kind::kRate, .name = "/scan", .window = 1s, .above = 20.5};

const LiveCondition kLateTopic{.kind = LiveCondition::Kind::kLate, .name = "/scan", .window = 2s, .max = 20ms};
const LiveCondition kLateNode{
    .kind = LiveCondition::Kind::kLate, .subject = Subject::kNode, .name = "/planner", .window = 2s, .max = 50ms};
const LiveCondition kLateService{.kind = LiveCondition::Kind::kLate,
                                 .subject = Subject::kService,
                                 .name = "/plan",
                                 .window = 5s,
                                 .max = 1s,
                                 .share = 0.99};

TEST(TimesOfConditions, HaveUnits) {
  EXPECT_EQ(parse_time_text("2s"), 2s);
  EXPECT_EQ(parse_time_text("1.5 s"), 1500ms);
  EXPECT_EQ(parse_time_text("500ms"), 500ms);
  EXPECT_EQ(parse_time_text("250us"), 250us);
  EXPECT_EQ(parse_time_text("1min"), 60s);
  for (const char* const wrong : {"", "2", "s", "2 h", "-1s", "1e400s", "nans", "infs", "2s2s", "2sec", "0x10s"}) {
    EXPECT_EQ(parse_time_text(wrong), std::nullopt) << wrong;
  }
  for (const char* const text : {"2s", "1.5s", "500ms", "250us", "60s", "0us"}) {
    EXPECT_EQ(time_text(*parse_time_text(text)), text);
  }
}

TEST(TextsOfConditions, SayWhatIsWatchedAndWhatHasHappened) {
  EXPECT_EQ(describe(kSilentTopic), "on_silence of topic /scan for 2s");
  EXPECT_EQ(describe(kSilentNode), "on_silence of node /planner for 500ms");
  EXPECT_EQ(describe(kSlow), "on_rate of topic /scan below 5 Hz in 2s");
  EXPECT_EQ(describe(kFast), "on_rate of topic /scan above 20.5 Hz in 1s");
  EXPECT_EQ(describe(kLateTopic), "on_late of topic /scan above 20ms");
  EXPECT_EQ(describe(kLateNode), "on_late of node /planner above 50ms");
  EXPECT_EQ(describe(kLateService), "on_late of service /plan above 1s, 0.99 of all in 5s");
  EXPECT_EQ(sentence(kLateTopic, {true, 0.0312, {}, 0.5}), "a message on /scan took 31.2 ms, more than 20ms");
  EXPECT_EQ(sentence(kLateTopic, {false, 0, {}}), "messages on /scan take no longer than 20ms again");
  EXPECT_EQ(sentence(kLateNode, {true, 0.081, {}, 1}), "a callback of /planner took 81 ms, more than 50ms");
  EXPECT_EQ(sentence(kLateService, {true, 1.25, {}, 0.074}),
            "7.4 % of the responses of /plan in 5s took longer than 1s, the last of them 1.25 s");
  EXPECT_EQ(sentence(kLateService, {false, 0, {}}), "responses of /plan take no longer than 1s again");
  EXPECT_EQ(sentence(kSilentTopic, {true, 2.0312, {}}), "no message on /scan for 2.03 s");
  EXPECT_EQ(sentence(kSilentTopic, {false, 3.4, {}}), "the silence of /scan is over after 3.4 s");
  EXPECT_EQ(sentence(kSilentNode, {true, 0.52, {}}), "no callback of /planner has ended for 0.52 s");
  EXPECT_EQ(sentence(kSlow, {true, 3.5, {}}), "3.5 messages/s on /scan in 2s, which is below 5");
  EXPECT_EQ(sentence(kSlow, {false, 5.5, {}}), "5.5 messages/s on /scan in 2s, no longer below 5");
  EXPECT_EQ(sentence(kFast, {true, 33, {}}), "33 messages/s on /scan in 1s, which is above 20.5");
}

TEST(Conditions, SayWhatMustBeRecordedForThem) {
  EXPECT_EQ(needs_of(kSilentTopic), "");
  EXPECT_EQ(needs_of(kFast), "");
  EXPECT_EQ(needs_of(kLateTopic), "messages");
  EXPECT_EQ(needs_of(kLateNode), "");
  EXPECT_EQ(needs_of(kLateService), "calls");
}

TEST(MessagesOfConditions, ComeBackAsTheyWere) {
  for (const LiveCondition& condition :
       {kSilentTopic, kSilentNode, kSlow, kFast, kLateTopic, kLateNode, kLateService}) {
    const std::string line = to_line(ConditionOrder(WatchCondition{7, condition}));
    EXPECT_EQ(std::get<WatchCondition>(parse_condition_order(line)).condition, condition) << line;
  }
  EXPECT_EQ(to_line(ConditionOrder(WatchCondition{1, kSilentTopic})),
            R"({"watch":1,"kind":"silence","topic":"/scan","window":2.0,"grace":10.0})"
            "\n");
  EXPECT_EQ(std::get<ForgetCondition>(parse_condition_order(to_line(ConditionOrder(ForgetCondition{3})))).id, 3U);

  const ConditionChanged changed{1, {true, 2.03, {"talker-1", "talker-2"}}};
  EXPECT_EQ(to_line(ConditionReport(changed)),
            R"({"condition":1,"holds":true,"figure":2.03,"processes":["talker-1","talker-2"]})"
            "\n");
  const auto back = std::get<ConditionChanged>(parse_condition_report(to_line(ConditionReport(changed))));
  EXPECT_EQ(back.id, 1U);
  EXPECT_EQ(back.change, changed.change);
  const ConditionChanged late{2, {true, 0.031, {"mapper-2"}, 0.04}};
  EXPECT_EQ(to_line(ConditionReport(late)),
            R"({"condition":2,"holds":true,"figure":0.031,"processes":["mapper-2"],"late":0.04})"
            "\n");
  EXPECT_EQ(std::get<ConditionChanged>(parse_condition_report(to_line(ConditionReport(late)))).change, late.change);
  const ConditionReport unseen = parse_condition_report(to_line(ConditionReport(NameNotSeen{2, {"/a", "/b"}})));
  EXPECT_THAT(std::get<NameNotSeen>(unseen).known, testing::ElementsAre("/a", "/b"));
  const ConditionReport failed = parse_condition_report(to_line(ConditionReport(WatchFailed{"why", "what to do", {}})));
  EXPECT_EQ(std::get<WatchFailed>(failed).help, "what to do");
  EXPECT_EQ(std::get<RecordingIsBehind>(parse_condition_report("{\"behind\":6.5}")).seconds, 6.5);
  EXPECT_TRUE(std::holds_alternative<NodesAreRecorded>(parse_condition_report("{\"recording\":true}")));
}

TEST(MessagesOfConditions, OfAnotherKindAreErrors) {
  for (const char* const wrong : {"", "{", "[1]", "{}", "{\"condition\":1}", "{\"unseen\":\"x\",\"known\":[]}"}) {
    EXPECT_THROW(parse_condition_report(wrong), std::runtime_error) << wrong;
  }
  for (const char* const wrong :
       {"", "{}", "{\"watch\":1}", R"({"watch":1,"kind":"odd","topic":"/a","window":1,"grace":1})",
        "{\"forget\":\"x\"}"}) {
    EXPECT_THROW(parse_condition_order(wrong), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace tracing
