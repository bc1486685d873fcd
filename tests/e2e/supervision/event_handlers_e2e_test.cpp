// SPDX-License-Identifier: Apache-2.0
// Event handlers, commands and the start order with real processes.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

class EventHandlers : public testing::Test {
 protected:
  std::string write(const std::string& actions) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  Sandbox sandbox_;
};

TEST_F(EventHandlers, ALineOfOneProcessRestartsAnother) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen" cmd="echo pid $$; exec cat"/>
    <executable name="watch" shell="true" output="screen" cmd="read line; exit 0">
      <depends_on process="worker" condition="output" pattern="^pid"/>
    </executable>
    <on_process_start process="watch"><restart process="worker"/></on_process_start>
    <on_process_exit process="worker" exit_code="SIGINT">
      <on_process_io process="worker" pattern="^pid [0-9]+$"><shutdown/></on_process_io>
    </on_process_exit>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::size_t first = result.out.find("[worker-1] pid ");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(result.out.find("[worker-1] pid ", first + 1), std::string::npos) << result.out;
}

TEST_F(EventHandlers, ATraceInAHandlerRecordsWhatTheHandlerStarts) {
  const std::string file = write(R"xml(
    <executable cmd="true" name="first"/>
    <on_process_exit process="first">
      <trace session-name="late"/>
      <executable cmd="echo second" output="screen"/>
    </on_process_exit>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_LT(result.out.find("writing tracing session to"), result.out.find("[echo-2] second"));
  EXPECT_THAT(result.out, HasSubstr("trace written to: " + (sandbox_.trace_directory() / "late").string()));
}

TEST_F(EventHandlers, OnShutdownRunsWhileTheOthersAreStillThere) {
  const std::string file = write(R"xml(
    <executable name="robot" shell="true" output="screen" cmd="touch up; end() { rm up; exit; }; trap end INT; echo ready; while :; do read x; done"/>
    <on_shutdown><executable name="park" shell="true" output="screen" cmd="test -e up &amp;&amp; echo still up"/></on_shutdown>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}, .directory = sandbox_.directory()});
  ASSERT_TRUE(run.wait_for_output("[robot-1] ready")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[park-2] still up"));
  EXPECT_FALSE(std::filesystem::exists(sandbox_.directory() / "up"));
}

TEST_F(EventHandlers, TheExitCodeOfARequiredProcessIsTheLaunchers) {
  const std::string file = write(R"xml(
    <arg name="code"/><executable name="other" cmd="cat"/>
    <executable name="brain" cmd="exit $(var code)" shell="true" required="true"/>)xml");
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file, "code:=7"}).exit_code, 7);
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file, "code:=0"}).exit_code, 0);
}

TEST_F(EventHandlers, ADependencyThatFailsEndsTheSystemWithItsPlace) {
  const std::string file = write(R"xml(<executable name="calibrate" cmd="exit 3" shell="true"/>
<executable name="drive" cmd="echo driving" output="screen"><depends_on process="calibrate" condition="exited"/></executable>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr(file + ":3:62: error: 'drive' can't start: 'calibrate' has ended with exit code 3"));
  EXPECT_THAT(result.out, Not(HasSubstr("driving")));
}

TEST_F(EventHandlers, LimitsAreAppliedAndARefusalIsAnErrorOfTheStart) {
  const std::string file = write(R"xml(<executable name="limited" shell="true" output="screen" nice="3"
 cmd="echo niceness `nice`; ulimit -n" open_files_limit="50" cpus="0"/>
<executable name="refused" cmd="echo started" output="screen" cpus="1000"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("[limited-1] niceness 3\n[limited-1] 50\n"));
  EXPECT_THAT(result.out, HasSubstr("cannot run on the CPUs 1000 (the launcher may use "));
  EXPECT_THAT(result.out, HasSubstr("Invalid argument (" + file + ":4:2)"));
  EXPECT_THAT(result.out, Not(HasSubstr("] started")));
}

TEST_F(EventHandlers, DryRunShowsThem) {
  const std::string file = write(R"xml(<executable cmd="a"/>
<executable cmd="b"><depends_on process="a" condition="exited" timeout="2.5" on_failure="skip"/></executable>
<on_process_exit process="b" exit_code="nonzero">
  <executable cmd="report $(var event.exit_code)"><env name="WHY" value="it died"/></executable>
  <signal process="a" signal="10"/>
  <log message="b has died"/>
  <on_process_start process="report"><shutdown/></on_process_start>
</on_process_exit>
<on_process_io pattern="x"><stop process="a"/></on_process_io>
<on_shutdown/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--dry-run", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "a (" + file + R"(:2:2)
  a

b ()" + file + R"(:3:2)
  b
  waits until 'a' has exited with exit code 0, at most 2.5 s; else skip

on_process_exit of 'b' with exit code nonzero ()" +
                            file + R"(:4:2)
  report ()" + file + R"(:5:4)
    report 1
    env: WHY='it died'

  on_process_start of 'report' ()" +
                            file + R"(:8:4)
    shutdown

  signal SIGUSR1 to 'a'
  log 'b has died'

on_process_io of any process with a line that matches 'x' ()" +
                            file + R"(:10:2)
  stop 'a'

on_shutdown ()" + file + R"(:11:2)

2 processes, 0 traces, 3 event handlers; nothing was started
)");
}

}  // namespace
