// SPDX-License-Identifier: Apache-2.0
// Launch files that are read again while they run; on virtual time, with processes that follow scripts.
#include "launcher/run/reload/reloads.hpp"

#include <fmt/ranges.h>
#include <signal.h>

#include "launcher/ros/fake/fake_ros_client.hpp"
#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ReloadsTest : public LaunchServiceTest {
 protected:
  // Runs the first text. After each further second the next one is asked for. The launch is ended after all.
  void run_texts(const std::vector<std::string>& texts, Reloads::Wish wish = {}) {
    on_service = [this, texts, wish](LaunchService& service) {
      service.reloads().use([this, texts] {
        const std::string& text = texts.at(++read_);
        return parse_launch_description(
            std::make_shared<SourceFile>("/test/system.launch.xml", "<launch>\n" + text + "\n</launch>"), registry_);
      });
      service.reloads().observe([this](const ReloadReport& report) { reports_.push_back(report); },
                                [this](const ReloadEnd& end) { ends_.push_back(end); });
      for (std::size_t i = 1; i < texts.size(); ++i) {
        timers_.push_back(loop_.after(i * 1s, [&service, wish] { service.reloads().ask(wish); }));
      }
      timers_.push_back(loop_.after(60s, [&service] { service.steering().shutdown(); }));
    };
    exit_code_ = run(texts.front());
  }

  // The processes that were started, each with its command line.
  std::vector<std::string> started() const {
    std::vector<std::string> all;
    for (const FakeProcessRunner::Spawned& spawned : runner_.spawned()) {
      all.push_back(fmt::format("{}", fmt::join(spawned.spec.argv, " ")));
    }
    return all;
  }

  static std::vector<std::string> names(const std::vector<ReloadReport::Line>& lines) {
    std::vector<std::string> all;
    for (const ReloadReport::Line& line : lines) {
      all.push_back(line.process);
    }
    return all;
  }

  std::size_t read_ = 0;
  int exit_code_ = -1;
  std::vector<ReloadReport> reports_;
  std::vector<ReloadEnd> ends_;
  std::vector<EventLoop::SourcePtr> timers_;
};

TEST_F(ReloadsTest, StartsEndsAndRestartsWhatHasChangedAndNothingElse) {
  run_texts({R"xml(<executable name="a" cmd="a"/><executable name="b" cmd="b 1"/><executable name="c" cmd="c"/>)xml",
             R"xml(<executable name="d" cmd="d"/><executable name="b" cmd="b 2"/>
                   <executable name="a" cmd="a"/>)xml"});
  EXPECT_EQ(exit_code_, 0);
  ASSERT_THAT(reports_, SizeIs(1));
  EXPECT_THAT(names(reports_[0].starts), ElementsAre("d"));
  EXPECT_THAT(names(reports_[0].ends), ElementsAre("c-3"));
  EXPECT_THAT(names(reports_[0].restarts), ElementsAre("b-2"));
  EXPECT_THAT(reports_[0].restarts[0].changes, ElementsAre("command line: 1 -> 2"));
  EXPECT_EQ(reports_[0].stays, 1U);
  EXPECT_THAT(started(), ElementsAre("a", "b 1", "c", "b 2", "d"));
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "start c-3", "exit b-2", "exit c-3", "start b-2",
                                    "start d-4", "exit a-1", "exit b-2", "exit d-4"));
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_THAT(ends_[0].failures, IsEmpty());
}

TEST_F(ReloadsTest, AFileWithAnErrorChangesNothing) {
  run_texts({R"xml(<executable name="a" cmd="a"/>)xml",
             R"xml(<executable name="b" cmd="b"/><executable name="a" cmd="$(var gone)"/>)xml"});
  EXPECT_EQ(exit_code_, 0);
  ASSERT_THAT(reports_, SizeIs(1));
  EXPECT_THAT(render(reports_[0].errors),
              "/test/system.launch.xml:2:57: error: launch configuration 'gone' does not exist\n"
              "    2 | <executable name=\"b\" cmd=\"b\"/><executable name=\"a\" cmd=\"$(var gone)\"/>\n"
              "      |                                                         ^~~~~~~~~~~\n"
              "      = help: declare it with 'arg', set it with 'let', or give a default: $(var gone DEFAULT)\n");
  EXPECT_THAT(started(), ElementsAre("a"));
  EXPECT_THAT(ends_, IsEmpty());
  EXPECT_THAT(messages_, Contains("[launch] reload: nothing is changed, because the launch file has an error"));
}

TEST_F(ReloadsTest, OnlyShowsWhenThatIsAskedFor) {
  run_texts({R"xml(<executable cmd="a"/>)xml", R"xml(<executable cmd="b"/>)xml"}, {.only_show = true});
  ASSERT_THAT(reports_, SizeIs(1));
  EXPECT_TRUE(reports_[0].only_shown);
  EXPECT_THAT(names(reports_[0].starts), ElementsAre("b"));
  EXPECT_THAT(names(reports_[0].ends), ElementsAre("a-1"));
  EXPECT_THAT(started(), ElementsAre("a"));
  EXPECT_THAT(ends_, IsEmpty());
}

TEST_F(ReloadsTest, OfSeveralOfOneNameThoseThatAreEqualGoOn) {
  run_texts(
      {R"xml(<executable name="t" cmd="t 1"/><executable name="t" cmd="t 2"/><executable name="t" cmd="t 3"/>)xml",
       R"xml(<executable name="t" cmd="t 2"/><executable name="t" cmd="t 3"/>)xml"});
  EXPECT_THAT(names(reports_.at(0).ends), ElementsAre("t-1"));
  EXPECT_EQ(reports_[0].stays, 2U);
  EXPECT_THAT(started(), SizeIs(3));
}

TEST_F(ReloadsTest, EnvironmentAndDirectoryAndLimitsAreReasonsForARestart) {
  run_texts({R"xml(<executable name="a" cmd="a"><env name="RATE" value="1"/></executable>
                   <executable name="b" cmd="b" cwd="/"/><executable name="c" cmd="c"/>)xml",
             R"xml(<executable name="a" cmd="a"><env name="RATE" value="2"/></executable>
                   <executable name="b" cmd="b" cwd="/tmp"/><executable name="c" cmd="c" nice="3"/>)xml"});
  ASSERT_THAT(reports_.at(0).restarts, SizeIs(3));
  EXPECT_THAT(reports_[0].restarts[0].changes, ElementsAre("environment: RATE 1 -> 2"));
  EXPECT_THAT(reports_[0].restarts[1].changes, ElementsAre("working directory: / -> /tmp"));
  EXPECT_THAT(reports_[0].restarts[2].changes, ElementsAre("limits"));
}

TEST_F(ReloadsTest, WhatIsNoMatterOfTheStartHoldsAtOnce) {
  runner_.script("a", {{.exits_after = 30s}, {}});
  run_texts({R"xml(<executable name="a" cmd="a"/><executable name="b" cmd="b"/>)xml",
             R"xml(<executable name="a" cmd="a" respawn="true"/><executable name="b" cmd="b"/>)xml"});
  EXPECT_THAT(names(reports_.at(0).takes_over), ElementsAre("a-1"));
  EXPECT_THAT(started(), ElementsAre("a", "b", "a"));
}

TEST_F(ReloadsTest, TheEndOfARequiredProcessThatIsGoneIsNoEndOfTheLaunch) {
  run_texts({R"xml(<executable name="a" cmd="a" required="true"/><executable name="b" cmd="b"/>)xml",
             R"xml(<executable name="b" cmd="b"/>)xml"});
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "exit a-1", "exit b-2"));
  EXPECT_EQ(exit_code_, 0);
}

TEST_F(ReloadsTest, HandlersAreThoseOfTheNewFileAndDoNotReactToTheReload) {
  runner_.script("b", {{.exits_after = 10s}});
  run_texts({R"xml(<executable name="a" cmd="a 1"/><executable name="b" cmd="b"/>
                   <on_process_exit process="a"><shutdown/></on_process_exit>
                   <on_process_exit process="b"><executable cmd="old"/></on_process_exit>)xml",
             R"xml(<executable name="a" cmd="a 2"/><executable name="b" cmd="b"/>
                   <on_process_exit process="a"><shutdown/></on_process_exit>
                   <on_process_exit process="b"><executable cmd="new"/></on_process_exit>)xml"});
  EXPECT_THAT(started(), ElementsAre("a 1", "b", "a 2", "new"));
}

TEST_F(ReloadsTest, WhatHandlersHaveStartedIsLeftAlone) {
  run_texts({R"xml(<on_process_start process="a"><executable name="h" cmd="h"/></on_process_start>
                   <executable name="a" cmd="a"/>)xml",
             R"xml(<executable name="a" cmd="a"/><executable name="b" cmd="b"/>)xml"});
  EXPECT_THAT(names(reports_.at(0).ends), IsEmpty());
  EXPECT_THAT(started(), ElementsAre("a", "h", "b"));
}

TEST_F(ReloadsTest, TimersCountFromTheBeginningAndWhatTheyHaveStartedGoesOn) {
  run_texts({R"xml(<executable name="a" cmd="a"/><timer period="0.5"><executable name="early" cmd="early"/></timer>
                   <timer period="10"><executable name="late" cmd="late 1"/></timer>)xml",
             R"xml(<executable name="a" cmd="a"/><timer period="0.5"><executable name="early" cmd="early"/></timer>
                   <timer period="10"><executable name="late" cmd="late 2"/></timer>)xml"});
  EXPECT_TRUE(reports_.at(0).changes_nothing());
  EXPECT_THAT(started(), ElementsAre("a", "early", "late 2"));
  EXPECT_EQ(runner_.spawned().at(2).at, 10s);
}

TEST_F(ReloadsTest, AProcessThatWaitsGoesOnWaitingOrBeginsAnew) {
  runner_.script("first", {{.exits_after = 20s}});
  run_texts({R"xml(<executable name="first" cmd="first"/>
                   <executable name="x" cmd="x"><depends_on process="first" condition="exited"/></executable>
                   <executable name="y" cmd="y 1"><depends_on process="x"/></executable>)xml",
             R"xml(<executable name="first" cmd="first"/>
                   <executable name="x" cmd="x"><depends_on process="first" condition="exited"/></executable>
                   <executable name="y" cmd="y 2"><depends_on process="x"/></executable>)xml"});
  EXPECT_THAT(names(reports_.at(0).starts), ElementsAre("y"));
  EXPECT_EQ(reports_[0].stays, 2U);
  EXPECT_THAT(started(), ElementsAre("first", "x", "y 2"));
}

TEST_F(ReloadsTest, AReloadWaitsForTheOneBefore) {
  runner_.script("a", {{.dies_after = 3s}});
  run_texts({R"xml(<executable name="a" cmd="a"/><executable name="z" cmd="z"/>)xml",
             R"xml(<executable name="b" cmd="b"/><executable name="z" cmd="z"/>)xml",
             R"xml(<executable name="c" cmd="c"/><executable name="z" cmd="z"/>)xml"});
  ASSERT_THAT(reports_, SizeIs(2));
  EXPECT_THAT(names(reports_[1].ends), ElementsAre("b-3"));
  EXPECT_THAT(started(), ElementsAre("a", "z", "b", "c"));
  EXPECT_EQ(runner_.spawned().at(2).at, 4s);
  EXPECT_THAT(ends_, SizeIs(2));
}

TEST_F(ReloadsTest, AnEmptyFileDoesNotEndTheLaunchBeforeTheNextProcesses) {
  run_texts({R"xml(<executable name="a" cmd="a"/>)xml", R"xml(<executable name="b" cmd="b"/>)xml"});
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start b-2", "exit b-2"));
}

TEST_F(ReloadsTest, AChangedTraceIsToldAndGoesOn) {
  run_texts({R"xml(<scope name="x"/><executable cmd="a"/>)xml", R"xml(<scope name="y"/><executable cmd="a"/>)xml"});
  EXPECT_THAT(reports_.at(0).notes, ElementsAre(HasSubstr("goes on as it began")));
  EXPECT_THAT(journal_, ElementsAre("begin x", "begun x", "start a-1", "exit a-1", "end x", "ended x"));
}

TEST_F(ReloadsTest, ANameOfAnonIsTheSameInEachReading) {
  const std::string text = R"xml(<executable name="$(anon a)" cmd="a"/>)xml";
  run_texts({text, text});
  EXPECT_TRUE(reports_.at(0).changes_nothing());
}

TEST_F(ReloadsTest, AProcessThatHasEndedStaysSoUnlessItHasChanged) {
  runner_.default_script({.exits_after = 100ms});
  runner_.script("z", {{}});
  run_texts({R"xml(<executable name="a" cmd="a"/><executable name="b" cmd="b 1"/><executable name="z" cmd="z"/>)xml",
             R"xml(<executable name="a" cmd="a"/><executable name="b" cmd="b 2"/><executable name="z" cmd="z"/>)xml"});
  EXPECT_THAT(started(), ElementsAre("a", "b 1", "z", "b 2"));
}

TEST_F(ReloadsTest, AStartThatFailsIsToldAtTheEnd) {
  runner_.script("a", {{}, {.spawn_error = ENOENT}});
  run_texts({R"xml(<executable name="a" cmd="a 1"/><executable name="z" cmd="z"/>)xml",
             R"xml(<executable name="a" cmd="a 2"/><executable name="z" cmd="z"/>)xml"});
  EXPECT_THAT(ends_.at(0).failures, ElementsAre(HasSubstr("a-1 has not started: ")));
}

std::string node(const std::string& parameters) {
  return R"xml(<node exec="a" name="n" namespace="/">)xml" + parameters + "</node>";
}

TEST_F(ReloadsTest, ParametersAreSetWhileTheNodeRuns) {
  test_support::FakeRosClient fake(loop_);
  client = &fake;
  fake.script("the '/n/set_parameters_atomically' service", {.ok = true});
  runner_.script("a", {{.exits_after = 30s}, {}});
  run_texts(
      {node(R"xml(<param name="rate" value="10"/><param name="frame" value="map"/>)xml"),
       node(R"xml(<param name="rate" value="20"/><param name="frame" value="map"/><param name="x" value="1"/>)xml")});
  ASSERT_THAT(reports_.at(0).sets, SizeIs(1));
  EXPECT_THAT(reports_[0].sets[0].changes, ElementsAre("parameter rate: 10 -> 20", "parameter x: new, 1"));
  EXPECT_THAT(fake.asked, ElementsAre("the '/n/set_parameters_atomically' service"));
  EXPECT_THAT(started(), SizeIs(1));
  EXPECT_THAT(ends_.at(0).failures, IsEmpty());
}

TEST_F(ReloadsTest, ANodeThatRefusesItsParametersStartsAgain) {
  test_support::FakeRosClient fake(loop_);
  client = &fake;
  RosAnswer refused;
  refused.error = "parameter 'rate' is read-only";
  fake.script("the '/n/set_parameters_atomically' service", refused);
  run_texts({node(R"xml(<param name="rate" value="10"/>)xml"), node(R"xml(<param name="rate" value="20"/>)xml")});
  EXPECT_THAT(started(), SizeIs(2));
  EXPECT_THAT(messages_,
              Contains("[a-1] its parameters can't be set while it runs: parameter 'rate' is read-only; it is "
                       "started again"));
  EXPECT_THAT(runner_.spawned().at(1).spec.files.at(0).content, HasSubstr("rate: 20"));
}

TEST_F(ReloadsTest, AParameterThatIsGoneOrTheWishForARestartStartsTheNodeAgain) {
  test_support::FakeRosClient fake(loop_);
  client = &fake;
  run_texts({node(R"xml(<param name="rate" value="10"/><param name="x" value="1"/>)xml"),
             node(R"xml(<param name="rate" value="10"/>)xml")});
  EXPECT_THAT(reports_.at(0).restarts.at(0).changes, ElementsAre("parameter x: gone"));
  EXPECT_THAT(fake.asked, IsEmpty());
  EXPECT_THAT(started(), SizeIs(2));
}

TEST_F(ReloadsTest, TheWishForARestartSetsNoParameters) {
  test_support::FakeRosClient fake(loop_);
  client = &fake;
  run_texts({node(R"xml(<param name="rate" value="10"/>)xml"), node(R"xml(<param name="rate" value="20"/>)xml")},
            {.restart = true});
  EXPECT_THAT(names(reports_.at(0).restarts), ElementsAre("a-1"));
  EXPECT_THAT(started(), SizeIs(2));
}

TEST_F(ReloadsTest, ComponentsAreLoadedAndUnloadedWhileTheContainerGoesOn) {
  test_support::FakeRosClient fake(loop_);
  client = &fake;
  for (const char* const name : {"stays", "changes", "goes", "comes"}) {
    fake.script(std::string("load /c ") + name, test_support::FakeRosClient::loaded(std::string("/") + name));
  }
  fake.script("the '/c/_container/unload_node' service", {.ok = true});
  const auto load = [](const std::string& nodes) {
    return R"xml(<executable cmd="a"/><load_composable_node target="/c">)xml" + nodes + "</load_composable_node>";
  };
  const std::string stays = R"xml(<composable_node pkg="p" plugin="P" name="stays"/>)xml";
  const std::string changes = R"xml(<composable_node pkg="p" plugin="P" name="changes">)xml";
  run_texts({load(stays + changes + R"xml(</composable_node><composable_node pkg="p" plugin="P" name="goes"/>)xml"),
             load(R"xml(<composable_node pkg="p" plugin="P" name="comes"/>)xml" + stays + changes +
                  R"xml(<param name="x" value="1"/></composable_node>)xml")});
  EXPECT_THAT(names(reports_.at(0).starts), ElementsAre("comes in /c"));
  EXPECT_THAT(names(reports_[0].ends), ElementsAre("goes in /c"));
  EXPECT_THAT(names(reports_[0].restarts), ElementsAre("changes in /c"));
  EXPECT_THAT(fake.asked,
              ElementsAre("load /c stays", "load /c changes", "load /c goes", "the '/c/_container/unload_node' service",
                          "load /c comes", "the '/c/_container/unload_node' service", "load /c changes"));
  EXPECT_THAT(started(), SizeIs(1));
}

TEST_F(ReloadsTest, WithoutAFileItIsRefused) {
  on_service = [this](LaunchService& service) {
    service.reloads().observe([this](const ReloadReport& report) { reports_.push_back(report); },
                              [](const ReloadEnd&) {});
    service.reloads().ask({});
  };
  run(R"xml(<executable cmd="a"/><timer period="1"><shutdown/></timer>)xml");
  EXPECT_EQ(reports_.at(0).refused, "this launch can't read its launch file again");
}

}  // namespace
}  // namespace launch
