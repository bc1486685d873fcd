// SPDX-License-Identifier: Apache-2.0
// The order of a run: scopes, processes, the end; on virtual time, with processes that follow scripts.
#include "launcher/run/launch_service.hpp"

#include <signal.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(LaunchServiceTest, ScopesBeginBeforeAndEndAfterEveryProcessWhereverTheyStand) {
  runner_.default_script({.exits_after = 100ms});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><scope name="x"/><executable cmd="b"/><scope name="y"/>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "begin y", "begun y", "start a-1", "start b-2", "exit a-1",
                                    "exit b-2", "end y", "ended y", "end x", "ended x"));
  EXPECT_EQ(runner_.spawned().at(0).spec.environment.at("SCOPES"), "xy");
}

TEST_F(LaunchServiceTest, AFailingScopeStartsNothingAndEndsTheOthers) {
  EXPECT_EQ(run(R"xml(<scope name="x"/><scope name="y" fails="true"/><scope name="z"/><executable cmd="a"/>)xml"), 1);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "begin y", "failed y", "end x", "ended x"));
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("/test/system.launch.xml:2:19: error: no tracer")));
}

TEST_F(LaunchServiceTest, AnErrorOfTheFirstVisitStartsNothing) {
  EXPECT_EQ(run(R"xml(<scope name="x"/><executable cmd="a"/><log message="$(var missing)"/>)xml"), 1);
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("launch configuration 'missing' does not exist")));
}

TEST_F(LaunchServiceTest, AnErrorOfALaterVisitShutsTheSystemDown) {
  EXPECT_EQ(
      run(R"xml(<scope name="x"/><executable cmd="a"/><timer period="1.0"><log message="$(var missing)"/></timer>)xml"),
      1);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "start a-1", "exit a-1", "end x", "ended x"));
  EXPECT_EQ(runner_.signals().at(0).signal, SIGINT);
}

TEST_F(LaunchServiceTest, EndsByItselfWhenNothingIsLeft) {
  EXPECT_EQ(run(R"xml(<log message="hello"/>)xml"), 0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] hello"));
}

TEST_F(LaunchServiceTest, APendingTimerKeepsTheLaunchAlive) {
  EXPECT_EQ(
      run(R"xml(<timer period="5.0"><executable cmd="late"/></timer><executable cmd="a"/><timer period="7"><shutdown/></timer>)xml"),
      0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start late-2", "exit a-1", "exit late-2"));
  EXPECT_EQ(runner_.spawned().at(1).at, 5s);
}

TEST_F(LaunchServiceTest, ShutdownFollowsTheWholeVisit) {
  EXPECT_EQ(run(R"xml(<shutdown/><executable cmd="a"/>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1"));
  EXPECT_EQ(runner_.signals().at(0).signal, SIGINT);
}

TEST_F(LaunchServiceTest, TimersAreCancelledByAShutdownUnlessTheyAskNotTo) {
  EXPECT_EQ(run(R"xml(<timer period="9.0"><log message="cancelled"/></timer>
                   <timer period="3.0" cancel_on_shutdown="false"><log message="fired"/><executable cmd="refused"/></timer>
                   <timer period="1.0"><shutdown/></timer>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] fired"));
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_EQ(loop_.now(), 3s);
}

TEST_F(LaunchServiceTest, OnExitShutdownEndsTheSystem) {
  runner_.script("required", {{.exits_after = 2s, .exit_code = 3}});
  EXPECT_EQ(run(R"xml(<executable cmd="other"/><executable cmd="required" on_exit="shutdown"/>)xml"), 3);
  EXPECT_EQ(messages_.at(0), "[launch] process[required-2] was required: shutting down launched system");
  EXPECT_THAT(journal_, ElementsAre("start other-1", "start required-2", "exit required-2", "exit other-1"));
}

TEST_F(LaunchServiceTest, AProcessThatCannotStartIsAFailureAndHonoursOnExit) {
  runner_.script("missing", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run(R"xml(<executable cmd="missing" on_exit="shutdown"/><executable cmd="other"/>)xml"), 3);
  EXPECT_THAT(journal_, IsEmpty());
}

TEST_F(LaunchServiceTest, ASecondSignalTerminatesAndAThirdKillsAndHurries) {
  runner_.default_script({.ignores = {SIGINT, SIGTERM}});
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  const auto second = loop_.after(2s, [this] { loop_.deliver_signal(SIGINT); });
  const auto third = loop_.after(3s, [this] { loop_.deliver_signal(SIGTERM); });
  EXPECT_EQ(run(R"xml(<scope name="x"/><executable cmd="stubborn"/>)xml"), 128 + SIGTERM);
  EXPECT_THAT(journal_,
              ElementsAre("begin x", "begun x", "start stubborn-1", "exit stubborn-1", "end x in a hurry", "ended x"));
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)",
                                     "[launch] user interrupted with ctrl-c (SIGINT) again, sent SIGTERM to "
                                     "stubborn-1; SIGKILL follows in 5 s, or with a third signal",
                                     "[launch] user interrupted with SIGTERM again, killing stubborn-1"));
  std::vector<int> sent;
  for (const auto& signal : runner_.signals()) {
    sent.push_back(signal.signal);
  }
  EXPECT_THAT(sent, ElementsAre(SIGINT, SIGTERM, SIGKILL, SIGKILL)) << "the last one is for its descendants";
  EXPECT_LT(loop_.now(), 4s);
}

TEST_F(LaunchServiceTest, ASignalInTheMiddleOfALargeStartEndsTheStart) {
  runner_.default_script({.start_takes = 3ms});
  const auto signal = loop_.after(5ms, [this] { loop_.deliver_signal(SIGINT); });
  std::string actions = "<shutdown reason='not reached'/>";
  for (int i = 0; i < 100; ++i) {
    actions += "<executable cmd='a'/>";
  }
  EXPECT_EQ(run(actions), 0);
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)"));
  EXPECT_EQ(runner_.spawned().size(), 4U) << "a slice of 10 ms";
  EXPECT_EQ(runner_.unreaped(), 0U);
}

TEST_F(LaunchServiceTest, SignalsWithinASecondAreOne) {
  runner_.default_script({.ignores = {SIGINT, SIGTERM}});
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGHUP); });
  const auto same = loop_.after(1900ms, [this] { loop_.deliver_signal(SIGHUP); });
  const auto another = loop_.after(1950ms, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="stubborn"/>)xml"), 0);
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with SIGHUP"));
  EXPECT_EQ(loop_.now(), 11s) << "SIGTERM and SIGKILL came after their timeouts";
}

TEST_F(LaunchServiceTest, ASecondSignalTerminatesOnlyProcessesThatAreLeft) {
  runner_.default_script({.ignores = {SIGINT}});
  runner_.script("quick", {{}});
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  const auto second = loop_.after(2s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="quick"/><executable cmd="a"/><executable cmd="b"/><executable cmd="c"/>
                   <executable cmd="d"/><executable cmd="e"/><executable cmd="f"/>)xml"),
            128 + SIGINT);
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)",
                                     "[launch] user interrupted with ctrl-c (SIGINT) again, sent SIGTERM to a-2, b-3, "
                                     "c-4, d-5, e-6 and 1 more; SIGKILL follows in 5 s, or with a third signal"));
  EXPECT_EQ(loop_.now(), 2s);
}

TEST_F(LaunchServiceTest, ASecondSignalWaitsForNoTimer) {
  runner_.default_script({.exits_after = 1h});
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  const auto second = loop_.after(2s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="3600" cancel_on_shutdown="false"/>)xml"), 128 + SIGINT);
  EXPECT_LT(loop_.now(), 3s);
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)",
                                     "[launch] user interrupted with ctrl-c (SIGINT) again, ending at once"));
}

TEST_F(LaunchServiceTest, ASignalWhileAScopeBeginsStartsNothingAndEndsIt) {
  const auto signal = loop_.after(5ms, [this] { loop_.deliver_signal(SIGTERM); });
  EXPECT_EQ(run(R"xml(<scope name="x"/><scope name="y"/><executable cmd="a"/>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "end x", "ended x"));
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with SIGTERM"));
}

TEST_F(LaunchServiceTest, AScopeThatCannotBeginAfterASignalEndsTheLaunch) {
  const auto signal = loop_.after(5ms, [this] { loop_.deliver_signal(SIGTERM); });
  EXPECT_EQ(run(R"xml(<scope name="x" fails="true"/><executable cmd="a"/>)xml"), 1);
  EXPECT_THAT(journal_, ElementsAre("begin x", "failed x"));
}

TEST_F(LaunchServiceTest, AScopeOfATimerBeginsBeforeItsProcesses) {
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="1.0"><executable cmd="b"/><scope name="late"/></timer>
                   <timer period="2.0"><shutdown/></timer>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "begin late", "begun late", "start b-2", "exit a-1", "exit b-2",
                                    "end late", "ended late"));
}

}  // namespace
}  // namespace launch
