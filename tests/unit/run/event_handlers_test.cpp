// SPDX-License-Identifier: Apache-2.0
// Event handlers: the time and the scope of their visit, and the requests that they may make.
#include <signal.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using EventHandlersTest = LaunchServiceTest;

TEST_F(EventHandlersTest, StartsAProcessWhenAnotherHasExitedWithTheCode) {
  runner_.script("calibrate", {{.exits_after = 2s}});
  runner_.script("drive", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="calibrate"/>
                   <on_process_exit process="calibrate" exit_code="0"><executable cmd="drive"/></on_process_exit>
                   <on_process_exit process="calibrate" exit_code="nonzero"><log message="failed"/></on_process_exit>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start calibrate-1", "exit calibrate-1", "start drive-2", "exit drive-2"));
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(EventHandlersTest, SeeTheEventAndTheScopeOfTheirPlace) {
  runner_.script("a", {{.exits_after = 1s, .exit_code = -SIGSEGV}});
  EXPECT_EQ(run(R"xml(<group><let name="x" value="inside"/>
                     <on_process_start process="a"><log message="$(var x): $(var event.process) has pid $(var event.pid)"/></on_process_start>
                     <on_process_exit><log message="$(var x): $(var event.process) ended with $(var event.exit_code)"/></on_process_exit>
                   </group>
                   <let name="x" value="outside"/>
                   <executable cmd="a" allowed-exit-codes="SIGSEGV"/>)xml"),
            0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.user] inside: a-1 has pid 1000001", "[launch.user] inside: a-1 ended with -11"));
}

TEST_F(EventHandlersTest, AreVisitedInTheOrderOfTheFileForEachEventUnlessOnce) {
  runner_.script("a", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<on_process_exit process="a"><log message="1"/></on_process_exit>
                   <on_process_exit><log message="2"/></on_process_exit>
                   <on_process_exit process="a-1" once="true"><log message="3"/></on_process_exit>
                   <executable cmd="a" respawn="true" respawn_max_retries="1"/>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] 1", "[launch.user] 2", "[launch.user] 3", "[launch.user] 1",
                                     "[launch.user] 2"));
}

TEST_F(EventHandlersTest, AreAllVisitedBeforeTheSystemIsIdle) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <on_process_exit process="a"><log message="first"/></on_process_exit>
                   <on_process_exit process="a"><executable cmd="b"/></on_process_exit>
                   <on_process_exit process="b"><log message="third"/></on_process_exit>
                   <on_process_exit process="b"><shutdown reason="done"/></on_process_exit>
                   <on_shutdown><log message="$(var event.reason)"/></on_shutdown>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start b-2", "exit b-2"));
  EXPECT_THAT(messages_, ElementsAre("[launch.user] first", "[launch.user] third", "[launch.user] done"));
}

TEST_F(EventHandlersTest, HearLinesOfTheirStreamThatMatch) {
  runner_.script("a", {{.exits_after = 3s,
                        .output = {{.at = 1s, .text = "no\nrea"},
                                   {.at = 2s, .text = "dy 7\r\n"},
                                   {.at = 2s, .text = "ready 8\n", .to_err = true}}}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <on_process_io process="a" pattern="ready \\d" stream="stdout">
                     <log message="$(var event.process) $(var event.stream): $(var event.text)"/>
                   </on_process_io>
                   <on_process_io pattern="^ready" stream="stderr"><log message="$(var event.text)"/></on_process_io>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] a-1 stdout: ready 7", "[launch.user] ready 8"));
}

TEST_F(EventHandlersTest, BeginTheScopesOfAHandlerBeforeItsProcesses) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <on_process_exit process="a"><executable cmd="b"/><scope name="late"/></on_process_exit>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "begin late", "begun late", "start b-2", "exit b-2",
                                    "end late", "ended late"));
}

TEST_F(EventHandlersTest, MayEndTheSystem) {
  runner_.script("a", {{.output = {{.at = 1s, .text = "fatal: no camera\n"}}}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><executable cmd="b"/>
                   <on_process_io pattern="^fatal"><shutdown/></on_process_io>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "exit a-1", "exit b-2"));
}

TEST_F(EventHandlersTest, AnErrorInAHandlerShutsTheSystemDown) {
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
<on_process_start><log message="$(var missing)"/></on_process_start>)xml"),
            1);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1"));
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("/test/system.launch.xml:3:33: error: launch configuration 'missing' "
                                             "does not exist")));
}

TEST_F(EventHandlersTest, AFailedStartCountsAsExitCode127) {
  runner_.script("missing", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run(R"xml(<executable cmd="missing"/>
                   <on_process_exit exit_code="127"><log message="seen"/></on_process_exit>)xml"),
            3);
  EXPECT_EQ(messages_.at(0), "[launch.user] seen");
}

TEST_F(EventHandlersTest, OnShutdownRunsItsProcessesBeforeTheOthersAreAskedToEnd) {
  runner_.script("park", {{.exits_after = 2s}});
  const auto signal = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="motor"/>
                   <on_shutdown><log message="$(var event.reason)"/><executable cmd="park"/></on_shutdown>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start motor-1", "start park-2", "exit park-2", "exit motor-1"));
  EXPECT_THAT(messages_,
              ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)", "[launch.user] ctrl-c (SIGINT)"));
  EXPECT_EQ(loop_.now(), 3s);
}

TEST_F(EventHandlersTest, OnShutdownIsOverAfterItsTimeout) {
  const auto signal = loop_.after(1s, [this] { loop_.deliver_signal(SIGTERM); });
  EXPECT_EQ(run(R"xml(<executable cmd="motor"/>
                   <on_shutdown timeout="2"><executable cmd="park"/></on_shutdown>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start motor-1", "start park-2", "exit motor-1", "exit park-2"));
  EXPECT_THAT(messages_, ElementsAre("[launch] user interrupted with SIGTERM",
                                     "[launch] on_shutdown: 2 s have passed, the system ends now"));
  EXPECT_EQ(loop_.now(), 3s);
}

TEST_F(EventHandlersTest, OnShutdownIsOverWithASecondSignal) {
  const auto first = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  const auto second = loop_.after(2s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(run(R"xml(<executable cmd="motor"/><on_shutdown><executable cmd="park"/></on_shutdown>)xml"), 128 + SIGINT);
  EXPECT_THAT(messages_,
              ElementsAre("[launch] user interrupted with ctrl-c (SIGINT)",
                          "[launch] user interrupted with ctrl-c (SIGINT) again, ending the actions of on_shutdown"));
  EXPECT_EQ(runner_.signals().at(0).signal, SIGINT);
  EXPECT_EQ(loop_.now(), 2s);
}

TEST_F(EventHandlersTest, OnShutdownIsVisitedAlsoWhenNothingIsLeftToRun) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <on_shutdown><log message="reason: $(var event.reason)"/><executable cmd="b"/></on_shutdown>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start b-2", "exit b-2"));
  EXPECT_THAT(messages_, ElementsAre("[launch.user] reason: idle"));
}

TEST_F(EventHandlersTest, OnShutdownCannotBeginAScope) {
  EXPECT_EQ(run(R"xml(<on_shutdown><scope name="x"/><executable cmd="a"/></on_shutdown>)xml"), 1);
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("a trace can't begin when the system ends")));
}

TEST_F(EventHandlersTest, OnMachineLostHearsOfItsMachineOrOfEach) {
  runner_.default_script({.exits_after = 3s});
  LaunchService* launch = nullptr;
  on_service = [&](LaunchService& service) { launch = &service; };
  const auto first = loop_.after(1s, [&] {
    launch->on_lost_machine({"arm", "its cable was cut", "talker-1, listener-2"});
  });
  const auto second = loop_.after(2s, [&] { launch->on_lost_machine({"base", "it was switched off", ""}); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <machine name="arm" connect="local"/>
                   <on_machine_lost machine="arm">
                     <log message="$(var event.machine): $(var event.reason), $(var event.processes)"/>
                     <executable cmd="instead"/>
                   </on_machine_lost>
                   <on_machine_lost once="true"><log message="once: $(var event.machine)"/></on_machine_lost>
                   <on_machine_lost><log message="each: $(var event.machine)"/></on_machine_lost>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch.user] arm: its cable was cut, talker-1, listener-2",
                                     "[launch.user] once: arm", "[launch.user] each: arm", "[launch.user] each: base"));
  EXPECT_THAT(journal_, testing::Contains("start instead-2"));
}

TEST_F(EventHandlersTest, OnMachineBackHearsOfItsMachineOrOfEach) {
  runner_.default_script({.exits_after = 3s});
  LaunchService* launch = nullptr;
  on_service = [&](LaunchService& service) { launch = &service; };
  const auto first = loop_.after(1s, [&] { launch->on_returned_machine({"arm", 3200ms, 17}); });
  const auto second = loop_.after(2s, [&] { launch->on_returned_machine({"base", 1s, 0}); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <machine name="arm" connect="local"/>
                   <on_machine_back machine="arm">
                     <log message="$(var event.machine): $(var event.for) s, $(var event.dropped) lines"/>
                   </on_machine_back>
                   <on_machine_back><log message="each: $(var event.machine)"/></on_machine_back>
                   <on_machine_lost><log message="never"/></on_machine_lost>)xml"),
            0);
  EXPECT_THAT(messages_,
              ElementsAre("[launch.user] arm: 3.2 s, 17 lines", "[launch.user] each: arm", "[launch.user] each: base"));
}

TEST_F(EventHandlersTest, HandlersAloneKeepNothingAlive) {
  EXPECT_EQ(run(R"xml(<on_process_exit><log message="never"/></on_process_exit>)xml"), 0);
  EXPECT_THAT(messages_, IsEmpty());
}

}  // namespace
}  // namespace launch
