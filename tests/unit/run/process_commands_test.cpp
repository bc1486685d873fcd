// SPDX-License-Identifier: Apache-2.0
// stop, restart, signal, and processes that are required.
#include <signal.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProcessCommandsTest : public LaunchServiceTest {
 protected:
  std::vector<std::string> signals() const {
    std::vector<std::string> lines;
    for (const FakeProcessRunner::Signalled& sent : runner_.signals()) {
      lines.push_back(fmt::format("SIG{} {}", ::sigabbrev_np(sent.signal), sent.pid - 1'000'000));
    }
    return lines;
  }
};

TEST_F(ProcessCommandsTest, StopEndsOneProcessThatWouldRespawn) {
  runner_.script("b", {{.exits_after = 5s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a" respawn="true"/><executable cmd="b"/>
                   <timer period="1.0"><stop process="a"/></timer>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "exit a-1", "exit b-2"));
  EXPECT_THAT(signals(), ElementsAre("SIGINT 1", "SIGKILL 1"));  // the last signal is for descendants
}

TEST_F(ProcessCommandsTest, StopEscalates) {
  runner_.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  EXPECT_EQ(run(R"xml(<executable cmd="a" sigterm_timeout="1" sigkill_timeout="2"/>
                   <timer period="1.0"><stop process="a"/></timer>)xml"),
            0);
  EXPECT_THAT(signals(), ElementsAre("SIGINT 1", "SIGTERM 1", "SIGKILL 1", "SIGKILL 1"));
  EXPECT_EQ(loop_.now(), 4s);
}

TEST_F(ProcessCommandsTest, RestartEndsAndStartsAgain) {
  runner_.script("a", {{.dies_after = 1s}, {.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a" required="true"/><timer period="1.0"><restart process="a"/></timer>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start a-1", "exit a-1"));
  EXPECT_EQ(loop_.now(), 3s);
}

TEST_F(ProcessCommandsTest, RestartStartsWhatHasEnded) {
  runner_.script("a", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="5.0"><restart process="a"/></timer>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start a-1", "exit a-1"));
}

TEST_F(ProcessCommandsTest, SignalGoesToAllOfTheNameAndDoesNotEscalate) {
  runner_.default_script({.exits_after = 5s, .ignores = {SIGINT}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><executable cmd="a"/>
                   <timer period="1.0"><signal process="a" signal="USR1"/></timer>
                   <timer period="2.0"><signal process="a-2" signal="SIGINT"/></timer>)xml"),
            0);
  EXPECT_THAT(signals(), ElementsAre("SIGUSR1 1", "SIGUSR1 2", "SIGINT 2", "SIGKILL 2"));
}

TEST_F(ProcessCommandsTest, WhatDoesNotRunGivesAWarning) {
  runner_.script("a", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
<timer period="2.0"><stop process="a"/></timer>)xml"),
            0);
  EXPECT_THAT(messages_, ElementsAre("[launch] stop: process 'a' does not run (/test/system.launch.xml:3:36)"));
}

TEST_F(ProcessCommandsTest, AnUnknownNameIsAnErrorBeforeAnythingStarts) {
  EXPECT_EQ(run(R"xml(<executable cmd="talker"/>
<stop process="talkr"/>)xml"),
            1);
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_THAT(errors_, ElementsAre("/test/system.launch.xml:3:16: error: no process is named 'talkr'\n"
                                   "    3 | <stop process=\"talkr\"/>\n"
                                   "      |                ^~~~~\n"
                                   "      = help: did you mean 'talker'?"));
}

TEST_F(ProcessCommandsTest, NodesAreKnownByTheirNames) {
  runner_.default_script({.exits_after = 9s});
  EXPECT_EQ(
      run(R"xml(<node exec="/bin/x" name="talker" namespace="/left"/><node exec="/bin/x" name="talker" namespace="/right"/>
                   <timer period="1.0"><signal process="/right/talker" signal="10"/></timer>
                   <timer period="2.0"><signal process="talker" signal="10"/></timer>)xml"),
      0);
  EXPECT_THAT(signals(), ElementsAre("SIGUSR1 2", "SIGUSR1 1", "SIGUSR1 2"));
}

TEST_F(ProcessCommandsTest, WhatDiesOfASignalThatWasSentHasNotFailed) {
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="1.0"><signal process="a" signal="TERM"/></timer>)xml"), 0);
}

TEST_F(ProcessCommandsTest, WhatFailsAfterASignalThatItHasCaughtHasFailed) {
  runner_.script("a", {{.exits_after = 5s, .exit_code = 9, .ignores = {SIGHUP}}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="1.0"><signal process="a" signal="HUP"/></timer>)xml"), 3);
}

TEST_F(ProcessCommandsTest, ARequiredProcessThatDiesOfASignalThatWasSentGives128AndTheSignal) {
  EXPECT_EQ(run(R"xml(<executable cmd="brain" required="true"/><executable cmd="other"/>
                   <timer period="1.0"><signal process="brain" signal="KILL"/></timer>)xml"),
            128 + SIGKILL);
}

TEST_F(ProcessCommandsTest, ARequiredProcessThatCannotBeStartedGives127) {
  runner_.script("brain", {{.spawn_error = ENOENT}});
  EXPECT_EQ(run(R"xml(<executable cmd="brain" required="true"/><executable cmd="other"/>)xml"), 127);
}

TEST_F(ProcessCommandsTest, TheEndOfARequiredProcessIsTheEndOfTheSystemWithItsExitCode) {
  runner_.script("brain", {{.exits_after = 2s, .exit_code = 3}});
  EXPECT_EQ(run(R"xml(<executable cmd="other"/><executable cmd="brain" required="true"/>)xml"), 3);
  EXPECT_EQ(messages_.at(0), "[launch] process[brain-2] was required: shutting down launched system");
  EXPECT_THAT(journal_, ElementsAre("start other-1", "start brain-2", "exit brain-2", "exit other-1"));
}

TEST_F(ProcessCommandsTest, ASignalThatEndsARequiredProcessCountsFrom128) {
  runner_.script("brain", {{.exits_after = 2s, .exit_code = -SIGSEGV}});
  EXPECT_EQ(run(R"xml(<executable cmd="brain" required="true"/>)xml"), 128 + SIGSEGV);
}

TEST_F(ProcessCommandsTest, ARequiredProcessThatEndsWellGivesZero) {
  runner_.script("brain", {{.exits_after = 2s}});
  EXPECT_EQ(run(R"xml(<executable cmd="brain" required="true"/>)xml"), 0);
}

TEST_F(ProcessCommandsTest, ARequiredProcessThatEndsAsAskedGivesZero) {
  EXPECT_EQ(
      run(R"xml(<executable cmd="muscle" required="true"/><timer period="1.0"><stop process="muscle"/></timer>)xml"),
      0);
}

TEST_F(ProcessCommandsTest, ARequiredProcessCannotRespawn) {
  EXPECT_EQ(run(R"xml(<executable cmd="a" required="true" respawn="true"/>)xml"), 1);
  EXPECT_THAT(errors_, ElementsAre("/test/system.launch.xml:2:31: error: a required process can't respawn: its end is "
                                   "the end of the system\n"
                                   "    2 | <executable cmd=\"a\" required=\"true\" respawn=\"true\"/>\n"
                                   "      |                               ^~~~\n"
                                   "      = help: leave out required or respawn"));
}

}  // namespace
}  // namespace launch
