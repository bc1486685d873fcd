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

const LiveCondition kLateAction{
    .kind = LiveCondition::Kind::kLate, .subject = Subject::kAction, .name = "/drive", .window = 2s, .max = 30s};
const LiveCondition kLateTimer{
    .kind = LiveCondition::Kind::kLate, .subject = Subject::kTimer, .name = "/planner", .window = 2s, .max = 5ms};
const LiveCondition kLateChain{.kind = LiveCondition::Kind::kLate,
                               .subject = Subject::kChain,
                               .name = "/camera -> /brake",
                               .window = 5s,
                               .max = 50ms,
                               .share = 0.9};
const LiveCondition kLoss{.kind = LiveCondition::Kind::kLoss, .name = "/scan", .window = 2s};
const LiveCondition kSomeLoss{.kind = LiveCondition::Kind::kLoss, .name = "/scan", .window = 5s, .share = 0.99};

LiveCondition of_process(LiveCondition::Kind kind, double above, std::chrono::nanoseconds window) {
  return {.kind = kind, .subject = Subject::kProcess, .name = "mapper", .window = window, .above = above};
}
const LiveCondition kMemory = of_process(LiveCondition::Kind::kMemory, 512.0 * 1024 * 1024, 5s);
const LiveCondition kGrowth = of_process(LiveCondition::Kind::kGrowth, 1536.0 * 1024 * 1024, 10min);
const LiveCondition kProcessor = of_process(LiveCondition::Kind::kProcessor, 0.9, 5s);

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
  EXPECT_EQ(describe(kLateChain), "on_late of chain /camera -> /brake above 50ms, 0.9 of all in 5s");
  EXPECT_EQ(describe(kLoss), "on_loss of topic /scan");
  EXPECT_EQ(describe(kSomeLoss), "on_loss of topic /scan above 0.01 of all in 5s");
  EXPECT_EQ(sentence(kLateAction, {true, 31, {}, 1}), "a result of /drive took 31 s, more than 30s");
  EXPECT_EQ(sentence(kLateTimer, {true, 0.0061, {}, 1}), "a timer of /planner waited 6.1 ms, more than 5ms");
  EXPECT_EQ(sentence(kLateTimer, {false, 0, {}}), "calls of timers of /planner wait no longer than 5ms again");
  EXPECT_EQ(sentence(kLateChain, {true, 0.062, {}, 0.2}),
            "20 % of the ways /camera -> /brake in 5s took longer than 50ms, the last of them 62 ms");
  EXPECT_EQ(sentence(kLoss, {true, 1, {}, 0.2}), "1 message on /scan lost");
  EXPECT_EQ(sentence(kLoss, {false, 0, {}}), "no message on /scan is lost any more");
  EXPECT_EQ(sentence(kSomeLoss, {true, 3, {}, 0.03}), "3 messages on /scan lost in 5s, 3 % of all, more than 1 %");
  EXPECT_EQ(sentence(kSomeLoss, {false, 0, {}}), "no more than 1 % of the messages on /scan are lost again");
  EXPECT_EQ(describe(kMemory), "on_memory of 'mapper' above 512 MiB for 5s");
  EXPECT_EQ(describe(kGrowth), "on_memory of 'mapper' that grows by more than 1.5 GiB in 600s");
  EXPECT_EQ(describe(kProcessor), "on_overload of 'mapper' above 90 % of a processor for 5s");
  EXPECT_EQ(sentence(kMemory, {true, 600.0 * 1024 * 1024, {}}),
            "mapper has 600 MiB of memory, for 5s more than 512 MiB");
  EXPECT_EQ(sentence(kMemory, {false, 0, {}}), "mapper has no more than 512 MiB of memory again");
  EXPECT_EQ(sentence(kGrowth, {true, 2048.0 * 1024 * 1024, {}}),
            "the memory of mapper has grown by 2 GiB in 600s, more than 1.5 GiB");
  EXPECT_EQ(sentence(kGrowth, {false, 0, {}}), "the memory of mapper grows by no more than 1.5 GiB in 600s again");
  EXPECT_EQ(sentence(kProcessor, {true, 0.9732, {}}), "mapper takes 97.3 % of a processor in 5s, more than 90 %");
  EXPECT_EQ(sentence(kProcessor, {false, 0, {}}), "mapper takes no more than 90 % of a processor again");
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
  EXPECT_EQ(needs_of(kLateAction), "calls");
  EXPECT_EQ(needs_of(kLateTimer), "");
  EXPECT_EQ(needs_of(kLateChain), "messages");
  EXPECT_EQ(needs_of(kLoss), "losses");
}

TEST(ChainsOfConditions, AreNodesWithArrowsBetweenThem) {
  EXPECT_THAT(nodes_of_chain("/a -> /b->c* ->/d").value(), testing::ElementsAre("/a", "/b", "c*", "/d"));
  for (const char* const wrong : {"", "/a", "/a /b", "/a ->", "-> /b", "/a -> -> /b", "/a -> /b /c"}) {
    EXPECT_EQ(nodes_of_chain(wrong), std::nullopt) << wrong;
  }
  EXPECT_EQ(chain_of_nodes({"/a", "/b"}), "/a -> /b");
}

TEST(MessagesOfConditions, ComeBackAsTheyWere) {
  for (const LiveCondition& condition : {kSilentTopic, kSilentNode, kSlow, kFast, kLateTopic, kLateNode, kLateService,
                                         kLateAction, kLateTimer, kLateChain, kLoss, kSomeLoss}) {
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
       {"", "{}", R"({"watch":1,"kind":"rate","window":1,"grace":1})", "{\"watch\":1}",
        R"({"watch":1,"kind":"odd","topic":"/a","window":1,"grace":1})", "{\"forget\":\"x\"}"}) {
    EXPECT_THROW(parse_condition_order(wrong), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace tracing
