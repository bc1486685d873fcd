// SPDX-License-Identifier: Apache-2.0
// Handlers of conditions on what nodes do. On virtual time, with a watch that tells what the test says.
#include "launcher/run/handlers/condition_handlers.hpp"

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class FakeConditionWatch : public ConditionWatch {
 public:
  void observe(Tell tell) override { tell_ = std::move(tell); }
  void watch(tracing::ConditionId id, const tracing::LiveCondition& condition) override {
    diary.push_back(fmt::format("watch {}: {}", id, describe(condition)));
  }
  void forget(tracing::ConditionId id) override { diary.push_back(fmt::format("forget {}", id)); }
  void close() override { diary.emplace_back("close"); }
  void tell(const tracing::ConditionReport& report) { tell_(report); }

  std::vector<std::string> diary;

 private:
  Tell tell_;
};

class ConditionHandlersTest : public LaunchServiceTest {
 protected:
  ConditionHandlersTest() {
    on_service = [this](LaunchService& service) {
      service.use_condition_watch(watch_);
      service.observe_conditions([this](const ConditionEvent& event) {
        events_.push_back(fmt::format("{} {}", describe(event.condition), event.change.holds));
      });
    };
    runner_.default_script({.exits_after = 60s});
  }

  void tell_at(Duration time, tracing::ConditionReport report) {
    timers_.push_back(loop_.after(time, [this, report = std::move(report)] { watch_.tell(report); }));
  }
  void holds_at(Duration time, tracing::ConditionId id = 1) {
    tell_at(time, tracing::ConditionChanged{id, {true, 2.031, {"talker-1"}}});
  }
  void is_over_at(Duration time, tracing::ConditionId id = 1) {
    tell_at(time, tracing::ConditionChanged{id, {false, 3.4, {"talker-1"}}});
  }

  FakeConditionWatch watch_;
  std::vector<std::string> events_;
  std::vector<EventLoop::SourcePtr> timers_;
};

constexpr const char* kOneCondition =
    R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/chatter" for="2s"><log message="visited"/></on_silence>)xml";

TEST_F(ConditionHandlersTest, AreNotVisitedAgainWhenAnotherProgramSaysThatAConditionHolds) {
  tell_at(1s, tracing::NodesAreRecorded{});
  holds_at(5s);
  holds_at(6s);
  tell_at(7s, tracing::NodesAreRecorded{});
  holds_at(10s);  // within twice its window and 5 s
  is_over_at(12s);
  holds_at(13s);
  EXPECT_EQ(run(kOneCondition), 0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no message on /chatter for 2.03 s (talker-1)", "[launch.user] visited",
                          "[launch.condition] the silence of /chatter is over after 3.4 s (talker-1)",
                          "[launch.condition] no message on /chatter for 2.03 s (talker-1)", "[launch.user] visited"));
}

TEST_F(ConditionHandlersTest, AConditionThatAnotherProgramFindsLaterHasBegunAgain) {
  tell_at(1s, tracing::NodesAreRecorded{});
  holds_at(5s);
  tell_at(7s, tracing::NodesAreRecorded{});
  holds_at(17s);
  EXPECT_EQ(run(kOneCondition), 0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no message on /chatter for 2.03 s (talker-1)", "[launch.user] visited",
                          "[launch.condition] no message on /chatter for 2.03 s (talker-1)", "[launch.user] visited"));
}

// What was put off is visited when it still holds, and not before that is known.
TEST_F(ConditionHandlersTest, AVisitThatACoolDownHasPutOffWaitsForTheOtherProgram) {
  tell_at(1s, tracing::NodesAreRecorded{});
  holds_at(5s);
  is_over_at(6s);
  holds_at(7s, 1);
  tell_at(8s, tracing::NodesAreRecorded{});
  holds_at(12s, 1);
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/chatter" for="2s" cool_down="10s"><log message="visited"/></on_silence>)xml"),
            0);
  EXPECT_EQ(std::count(messages_.begin(), messages_.end(), "[launch.user] visited"), 2);
}

TEST_F(ConditionHandlersTest, AVisitThatACoolDownHasPutOffIsLeftOutIfTheOtherProgramDoesNotFindIt) {
  tell_at(1s, tracing::NodesAreRecorded{});
  holds_at(5s);
  is_over_at(6s);
  holds_at(7s, 1);
  tell_at(8s, tracing::NodesAreRecorded{});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/chatter" for="2s" cool_down="10s"><log message="visited"/></on_silence>)xml"),
            0);
  EXPECT_EQ(std::count(messages_.begin(), messages_.end(), "[launch.user] visited"), 1);
}

TEST_F(ConditionHandlersTest, AreVisitedEachTimeTheConditionBeginsToHold) {
  holds_at(5s);
  is_over_at(6s);
  holds_at(8s);
  tell_at(9s, tracing::ConditionChanged{2, {true, 3.5, {"talker-1", "talker-2"}}});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/><push_ros_namespace namespace="left"/>
<on_silence topic="chatter" for="2s"><log message="$(var event.topic), $(var event.for), $(var event.process)"/></on_silence>
<on_rate topic="/scan" below="5"><log message="$(var event.rate) of $(var event.below) in $(var event.window), $(var event.process)"/>
</on_rate>)xml"),
            0);
  EXPECT_THAT(errors_, IsEmpty());
  EXPECT_THAT(watch_.diary, ElementsAre("watch 1: on_silence of topic /left/chatter for 2s",
                                        "watch 2: on_rate of topic /scan below 5 Hz in 2s", "close"));
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no message on /left/chatter for 2.03 s (talker-1)",
                          "[launch.user] /left/chatter, 2s, talker-1",
                          "[launch.condition] the silence of /left/chatter is over after 3.4 s (talker-1)",
                          "[launch.condition] no message on /left/chatter for 2.03 s (talker-1)",
                          "[launch.user] /left/chatter, 2s, talker-1",
                          "[launch.condition] 3.5 messages/s on /scan in 2s, which is below 5 (talker-1, talker-2)",
                          "[launch.user] 3.5 of 5 in 2s, talker-1, talker-2"));
  EXPECT_THAT(
      events_,
      ElementsAre("on_silence of topic /left/chatter for 2s true", "on_silence of topic /left/chatter for 2s false",
                  "on_silence of topic /left/chatter for 2s true", "on_rate of topic /scan below 5 Hz in 2s true"));
}

TEST_F(ConditionHandlersTest, SayWhatWasLate) {
  tell_at(5s, tracing::ConditionChanged{1, {true, 0.0312, {"mapper-1"}, 0.04}});
  tell_at(6s, tracing::ConditionChanged{1, {false, 0, {"mapper-1"}}});
  tell_at(7s, tracing::ConditionChanged{2, {true, 1.25, {"planner-2"}, 1}});
  tell_at(8s, tracing::NameNotSeen{3, {"/plan"}});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_late topic="/scan" max="20ms" share="0.99" window="5s">
  <log message="$(var event.topic): $(var event.took) of $(var event.max), $(var event.share) in $(var event.window)"/>
</on_late>
<on_late node="/planner" max="1s"><log message="$(var event.node), $(var event.process)"/></on_late>
<on_late service="/plann" max="1s"/>)xml"),
            0);
  EXPECT_THAT(watch_.diary, ElementsAre("watch 1: on_late of topic /scan above 20ms, 0.99 of all in 5s",
                                        "watch 2: on_late of node /planner above 1s",
                                        "watch 3: on_late of service /plann above 1s", "close"));
  EXPECT_THAT(
      messages_,
      ElementsAre("[launch.condition] 4 % of the messages on /scan in 5s took longer than 20ms, the last of "
                  "them 31.2 ms (mapper-1)",
                  "[launch.user] /scan: 0.0312 of 20ms, 0.96 in 5s",
                  "[launch.condition] messages on /scan take no longer than 20ms again (mapper-1)",
                  "[launch.condition] a callback of /planner took 1.25 s, more than 1s (planner-2)",
                  "[launch.user] /planner, planner-2", testing::HasSubstr("no client of /plann was ever seen")));
}

TEST_F(ConditionHandlersTest, WithOnceAreForgottenAfterTheFirstTime) {
  holds_at(5s);
  is_over_at(6s);
  holds_at(7s);
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence node="/talker" for="2s" once="true"><restart process="talker"/></on_silence>)xml"),
            0);
  EXPECT_THAT(watch_.diary, ElementsAre("watch 1: on_silence of node /talker for 2s", "forget 1", "close"));
  EXPECT_THAT(messages_, ElementsAre("[launch.condition] no callback of /talker has ended for 2.03 s (talker-1)"));
  EXPECT_THAT(journal_, Contains("start talker-1").Times(2));
}

TEST_F(ConditionHandlersTest, WaitForTheirCoolDownAndThenActIfTheConditionStillHolds) {
  holds_at(5s);
  is_over_at(6s);
  holds_at(7s);  // for good: visited at 15 s
  holds_at(5s, 2);
  is_over_at(6s, 2);
  holds_at(7s, 2);
  is_over_at(8s, 2);
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/a" for="2s" cool_down="10s"><log message="a"/></on_silence>
<on_silence topic="/b" for="2s" cool_down="10s"><log message="b"/></on_silence>)xml"),
            0);
  EXPECT_THAT(messages_, Contains("[launch.user] a").Times(2));
  EXPECT_THAT(messages_, Contains("[launch.user] b").Times(1));
}

TEST_F(ConditionHandlersTest, AreSilentWhileTheSystemEnds) {
  runner_.script("talker", {{.exits_after = 20s, .dies_after = 5s}});
  holds_at(3s);
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/><timer period="2"><shutdown reason="done"/></timer>
<on_silence topic="/a" for="1s"><log message="never"/></on_silence>)xml"),
            0);
  EXPECT_THAT(messages_, testing::Not(Contains("[launch.user] never")));
  EXPECT_THAT(watch_.diary, Contains("close"));
}

TEST_F(ConditionHandlersTest, WithoutATraceAreAnError) {
  EXPECT_EQ(run(R"xml(<executable cmd="talker"/>
<on_silence topic="/a" for="1s"/>)xml"),
            1);
  EXPECT_THAT(
      errors_,
      ElementsAre(
          R"(/test/system.launch.xml:3:2: error: nothing is recorded that could tell whether this condition holds
    3 | <on_silence topic="/a" for="1s"/>
      |  ^~~~~~~~~~
      = help: add <trace session-name="…"/> to the launch file, or start it with launch --trace)"));
  EXPECT_THAT(journal_, IsEmpty());
}

// These processes are not real, so nothing can be said of what they use.
TEST_F(ConditionHandlersTest, OnProcessesNeedNoTraceAndAreNotAskedForOutside) {
  EXPECT_EQ(run(R"xml(<executable cmd="talker" name="talker"/>
<on_memory process="taker" above="1M" grace="3s"/>
<on_overload process="talker" above="50%" grace="3s"/>)xml"),
            0);
  EXPECT_THAT(errors_, IsEmpty());
  EXPECT_THAT(watch_.diary, ElementsAre("close"));
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no process taker was ever seen, 3s after the begin of the watch "
                          "(/test/system.launch.xml:3:2); did you mean 'talker'?"));
}

TEST_F(ConditionHandlersTest, TellWhichNodeOfAChainWasNotSeen) {
  tell_at(12s, tracing::NameNotSeen{1, {"/camera", "/brake"}});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_late chain="/cam* -> brakes" max="50ms"/>)xml"),
            0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no node /brakes was ever seen, 10s after the begin of the recording "
                          "(/test/system.launch.xml:3:2); did you mean '/brake'?"));
}

TEST_F(ConditionHandlersTest, TellOfNamesThatWereNotSeen) {
  tell_at(5s, tracing::NodesAreRecorded{});
  tell_at(12s, tracing::NameNotSeen{1, {"/chatter"}});
  tell_at(12s, tracing::NameNotSeen{2, {}});
  tell_at(13s, tracing::RecordingIsBehind{6.2});
  tell_at(14s, tracing::RecordingIsBehind{0});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/chater" for="1s"/>
<on_silence node="/x" for="1s" grace="5s"/>)xml"),
            0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.condition] no publisher of /chater was ever seen, 10s after the begin of the "
                          "recording (/test/system.launch.xml:3:2); did you mean '/chatter'?",
                          "[launch.condition] no node /x was ever seen, 5s after the begin of the recording "
                          "(/test/system.launch.xml:4:2)",
                          "[launch.condition] what nodes do comes 6 s late: until then no condition is decided",
                          "[launch.condition] what nodes do is known in time again"));
}

TEST_F(ConditionHandlersTest, EndTheLaunchIfTheyCannotBeWatchedFromTheBeginOn) {
  tell_at(2s,
          tracing::WatchFailed{"there is no 'lttng-relayd' on this machine", "install the package lttng-tools", {}});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/a" for="1s"/>)xml"),
            1);
  EXPECT_THAT(
      errors_,
      ElementsAre(
          R"(/test/system.launch.xml:3:2: error: this condition can't be watched: there is no 'lttng-relayd' on this machine
    3 | <on_silence topic="/a" for="1s"/>
      |  ^~~~~~~~~~
      = help: install the package lttng-tools)"));
}

TEST_F(ConditionHandlersTest, GoOnWithoutTheWatchIfItEndsLater) {
  tell_at(1s, tracing::NodesAreRecorded{});
  tell_at(2s, tracing::WatchFailed{"launch-watch was ended by SIGKILL", "", true});
  tell_at(3s, tracing::WatchFailed{"launch-watch was ended by SIGKILL", "", false});
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/a" for="1s"/>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.condition] conditions on what nodes do are not watched for a moment: "
                                     "launch-watch was ended by SIGKILL",
                                     "[launch.condition] conditions on what nodes do are not watched any more: "
                                     "launch-watch was ended by SIGKILL"));
}

TEST_F(ConditionHandlersTest, HearNothingMoreOnceUnregistered) {
  holds_at(5s);
  EXPECT_EQ(run(R"xml(<scope name="trace"/><executable cmd="talker"/>
<on_silence topic="/a" for="1s" name="silent"><log message="never"/></on_silence>
<timer period="2"><unregister_event_handler name="silent"/></timer>)xml"),
            0);
  EXPECT_THAT(messages_, IsEmpty());
  EXPECT_THAT(watch_.diary, ElementsAre("watch 1: on_silence of topic /a for 1s", "forget 1", "close"));
}

}  // namespace
}  // namespace launch
