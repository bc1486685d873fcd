// SPDX-License-Identifier: Apache-2.0
// watch: what it is evaluated to.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using namespace std::chrono_literals;
using test_support::plan_actions;
using test_support::Planned;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<launch::HealthWatch> watches_of(const Planned& planned) {
  EXPECT_EQ(planned.error, "");
  return planned.plan.processes.empty() ? std::vector<launch::HealthWatch>() : planned.plan.processes[0].watches;
}

std::vector<launch::HealthWatch> watches(const std::string& items) {
  return watches_of(plan_actions("<executable cmd=\"a\">" + items + "</executable>"));
}

TEST(Watch, HasDefaultsByItsKind) {
  const std::vector<launch::HealthWatch> found = watches(
      R"(<watch kind="executor"/><watch kind="command" cmd="check 'a b'"/><watch kind="output" timeout="60"/>)");
  ASSERT_THAT(found, SizeIs(3));
  EXPECT_EQ(found[0].timeout, 5s);
  EXPECT_EQ(found[0].interval, 1s);
  EXPECT_EQ(found[0].failures, 1);
  EXPECT_EQ(found[0].reaction, launch::OnUnhealthy::kNothing);
  EXPECT_THAT(std::get<launch::CommandSucceeds>(found[1].subject).argv, ElementsAre("check", "a b"));
  EXPECT_EQ(found[1].interval, 10s);
  EXPECT_EQ(found[1].failures, 3);
  EXPECT_EQ(found[2].interval, 1s) << "a long time-out is looked at each second";
}

TEST(Watch, LooksOftenForAShortTimeOut) {
  EXPECT_EQ(watches(R"(<watch kind="executor" timeout="1"/>)").at(0).interval, 200ms);
  EXPECT_EQ(watches(R"(<watch kind="executor" timeout="0.1"/>)").at(0).interval, 50ms);
}

TEST(Watch, TakesSubstitutionsAndConditions) {
  const std::vector<launch::HealthWatch> found = watches_of(plan_actions(R"xml(
    <arg name="what" default="restart"/>
    <arg name="time" default="2.5"/>
    <executable cmd="a">
      <watch kind="executor" timeout="$(var time)" on_unhealthy="$(var what)"/>
      <watch kind="output" if="false"/>
    </executable>)xml"));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].timeout, 2500ms);
  EXPECT_EQ(found[0].reaction, launch::OnUnhealthy::kRestart);
}

TEST(Watch, SendsSigabrtUnlessAnotherSignalIsGiven) {
  EXPECT_EQ(watches(R"(<watch kind="blocked" on_unhealthy="signal"/>)").at(0).signal, SIGABRT);
  EXPECT_EQ(watches(R"(<watch kind="blocked" on_unhealthy="signal" signal="QUIT"/>)").at(0).signal, SIGQUIT);
}

TEST(Watch, IsInEachTagThatRunsAProcess) {
  EXPECT_THAT(watches_of(plan_actions(R"(<node exec="/bin/true"><watch kind="executor"/></node>)")), SizeIs(1));
}

TEST(Watch, IsDescribedInADryRun) {
  std::vector<std::string> texts;
  for (const launch::HealthWatch& watch :
       watches(R"(<watch kind="executor" timeout="2" on_unhealthy="restart"/><watch kind="output" stream="stderr"/>
                  <watch kind="output" pattern="^tick"/><watch kind="blocked"/><watch kind="command" cmd="a b"/>)")) {
    texts.push_back(describe(watch));
  }
  EXPECT_THAT(texts, ElementsAre("its executors never stand still for 2 s; else restart",
                                 "it prints a line on stderr at least every 5 s",
                                 "it prints a line that matches '^tick' at least every 5 s",
                                 "it is never blocked for 5 s", "'a b' ends with 0 within 5 s, 3 failures in a row"));
}

TEST(Watch, FromOutsideIsRead) {
  const std::vector<launch::HealthWatch> found =
      watches(R"(<watch kind="topic" topic="/scan" min_rate="5"/><watch kind="topic" topic="map"/>
                 <watch kind="service" service="/map/load" timeout="2"/><watch kind="lifecycle" node="/n"/>
                 <watch kind="port" port="8080"/><watch kind="port" port="53" protocol="udp"/>
                 <watch kind="port" socket="@map"/><watch kind="port" port="80" host="::1"/>
                 <watch kind="notify" watchdog="true" timeout="3"/>)");
  std::vector<std::string> texts;
  for (const launch::HealthWatch& watch : found) {
    texts.push_back(describe(watch));
  }
  EXPECT_THAT(texts, ElementsAre("'/scan' has at least 5 messages a second, over 5 s",
                                 "a message comes on '/map' at least every 5 s",
                                 "the service '/map/load' answers within 2 s", "'/n' is active, and says so within 5 s",
                                 "localhost:8080 accepts connections within 5 s, 3 failures in a row",
                                 "it has the UDP port 53, 3 failures in a row",
                                 "@map accepts connections within 5 s, 3 failures in a row",
                                 "[::1]:80 accepts connections within 5 s, 3 failures in a row",
                                 "it says within 3 s that it is ready, and then as often that it lives"));
  EXPECT_EQ(found[0].interval, 1s);
  EXPECT_EQ(found[2].interval, 1s);
  EXPECT_EQ(found[3].interval, 2500ms);
  EXPECT_EQ(found[4].interval, 5s);
}

TEST(Watch, OfMemoryAndLoadIsRead) {
  const std::vector<launch::HealthWatch> found =
      watches(R"(<watch kind="memory" max_memory="500M" max_growth="64K"/><watch kind="memory" max_growth="1G"/>
                 <watch kind="load" max_load="150%" timeout="10"/>)");
  ASSERT_THAT(found, SizeIs(3));
  EXPECT_EQ(describe(found[0]),
            "it does not have more than 500.0 MiB of memory and does not grow by more than 0.1 MiB for 5 s");
  EXPECT_EQ(describe(found[1]), "it does not grow by more than 1024.0 MiB for 5 s");
  EXPECT_EQ(describe(found[2]), "it uses at most 150 % of a processor, over 10 s");
  EXPECT_EQ(found[2].interval, 1s);
}

TEST(Watch, OfALifeCycleKnowsTheNodeOfItsProcess) {
  const std::vector<launch::HealthWatch> found = watches_of(plan_actions(
      R"(<group ns="left"><node exec="/bin/true" name="driver"><watch kind="lifecycle"/></node></group>)"));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(std::get<launch::LifecycleState>(found[0].subject).node, "/left/driver");
}

TEST(Watch, ADependencyOnHealthNeedsOne) {
  const Planned planned = plan_actions(R"xml(
    <executable cmd="a" name="driver"/>
    <executable cmd="b"><depends_on process="driver" condition="healthy"/></executable>)xml");
  EXPECT_THAT(planned.error, HasSubstr("error: nothing tells whether 'driver' is healthy"));
}

TEST(StartLimit, IsReadWithWhatFollows) {
  const Planned planned = plan_actions(
      R"(<executable cmd="a" respawn="true" start_limit="5" start_limit_interval="30" start_limit_cool_down="90"/>
         <executable cmd="b" respawn="true" start_limit="2" on_start_limit="shutdown"/>)");
  ASSERT_EQ(planned.error, "");
  const launch::StartLimit& first = planned.plan.processes.at(0).start_limit;
  EXPECT_EQ(first.starts, 5);
  EXPECT_EQ(first.within, 30s);
  EXPECT_EQ(first.cool_down, 90s);
  EXPECT_FALSE(first.shuts_down);
  const launch::StartLimit& second = planned.plan.processes.at(1).start_limit;
  EXPECT_EQ(second.within, 60s);
  EXPECT_FALSE(second.cool_down);
  EXPECT_TRUE(second.shuts_down);
}

}  // namespace
