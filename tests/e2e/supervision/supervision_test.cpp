// SPDX-License-Identifier: Apache-2.0
// Real processes that misbehave: they ignore signals, crash, can't start, or leave children.
#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>

#include <cerrno>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

class Supervision : public testing::Test {
 protected:
  std::string write(const std::string& actions) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  // The processes that the launcher leaves become our children, and so does the guardian that ends them. All of them
  // end by themselves; the test waits for them until its time is over.
  static void wait_until_all_have_gone() {
    while (::waitpid(-1, nullptr, 0) > 0) {
    }
    EXPECT_EQ(errno, ECHILD);
  }

  Sandbox sandbox_;
};

TEST_F(Supervision, ANodeThatIgnoresSigintIsTerminatedThenKilled) {
  const std::string file = write(R"xml(
    <executable name="stubborn" shell="true" output="screen" sigterm_timeout="0.2" sigkill_timeout="0.2"
                cmd="trap : INT TERM; echo ready; while :; do read x; done"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[stubborn-1] ready")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("sending signal 'SIGINT' to process[stubborn-1]"));
  EXPECT_THAT(result.out, HasSubstr("process[stubborn-1] failed to terminate '0.2' seconds after receiving 'SIGINT', "
                                    "escalating to 'SIGTERM'"));
  EXPECT_THAT(result.out, HasSubstr("seconds after receiving 'SIGTERM', escalating to 'SIGKILL'"));
  EXPECT_THAT(result.out, HasSubstr("exit code -9"));
}

TEST_F(Supervision, MoreCtrlCsTerminateThenKillAndStillDestroyTheSession) {
  const std::string file = write(R"xml(
    <trace session-name="hurry"/>
    <executable name="stubborn" shell="true" output="screen" sigterm_timeout="1000" sigkill_timeout="1000"
                cmd="trap : INT TERM; echo ready; while :; do read x; done"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[stubborn-1] ready")) << run.out() << run.err();
  run.send_signal(SIGINT);
  ASSERT_TRUE(run.wait_for_output("sending signal 'SIGINT'"));
  // A signal does not count for a second after the last one.
  const auto press_until = [&run](const std::string& text) {
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
      run.send_signal(SIGINT);
      if (run.wait_for_output(text, std::chrono::milliseconds(300))) {
        return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(
      press_until("(SIGINT) again, sent SIGTERM to stubborn-1; SIGKILL follows in 1000 s, or with a third signal"));
  EXPECT_TRUE(press_until("user interrupted with ctrl-c (SIGINT) again, killing stubborn-1"));
  const CommandResult result = run.wait();
  EXPECT_FALSE(result.timed_out);
  const CommandResult sessions = run_command({"lttng", "list"});
  EXPECT_THAT(sessions.out + sessions.err, HasSubstr("Currently no available recording session"));
}

// timeout(1) signals its command and then the group of the command; a terminal that is closed sends SIGHUP twice.
TEST_F(Supervision, ASignalThatComesTwiceLeavesProcessesTheirTime) {
  const std::string file = write(R"xml(
    <executable name="careful" shell="true" output="screen" sigterm_timeout="1000"
                cmd="end() { sleep 0.3; echo cleaned up; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  for (const int signal : {SIGHUP, SIGTERM}) {
    RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
    ASSERT_TRUE(run.wait_for_output("[careful-1] ready")) << run.out() << run.err();
    run.send_signal(signal);
    run.send_signal(signal);
    const CommandResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, HasSubstr("[careful-1] cleaned up"));
    EXPECT_THAT(result.out, Not(HasSubstr("again")));
  }
}

TEST_F(Supervision, WithNohupTheLaunchOutlivesItsTerminal) {
  const std::string file =
      write(R"xml(<executable name="waiter" shell="true" output="screen" cmd="echo ready; exec cat"/>)xml");
  RunningCommand run({.argv = {"nohup", LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[waiter-1] ready"));
  run.send_signal(SIGHUP);
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, Not(HasSubstr("SIGHUP")));
  EXPECT_THAT(result.out, HasSubstr("user interrupted with ctrl-c (SIGINT)"));
}

TEST_F(Supervision, AStoppedProcessGoesOnToEnd) {
  const std::string file = write(R"xml(
    <executable name="stopped" shell="true" output="screen" sigterm_timeout="1000"
                cmd="end() { echo interrupted; exit; }; trap end INT; echo ready; kill -STOP $$; while :; do read x; done"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[stopped-1] ready"));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[stopped-1] interrupted"));
}

// A service manager sends it when a launch does not feed its watchdog.
TEST_F(Supervision, SigabrtEndsALauncherThatIsStoppedAndItsProcessesEndGently) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen"
                cmd="end() { echo cleaned up; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[worker-1] ready"));
  const CommandResult launcher =
      run_command({"sh", "-c", "kill -STOP $(pgrep -P $(pgrep -P " + std::to_string(run.pid()) + "))"});
  ASSERT_EQ(launcher.exit_code, 0);
  run.send_signal(SIGABRT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.signal, SIGABRT);
  EXPECT_THAT(result.out, HasSubstr("the launcher was ended by SIGABRT"));
  EXPECT_THAT(result.out, HasSubstr("[worker-1] cleaned up"));
}

TEST_F(Supervision, CtrlZStopsTheSystemAndSigcontContinuesIt) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen"
                cmd="end() { echo cleaned up; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[worker-1] ready"));
  run.send_signal(SIGTSTP);
  siginfo_t stopped{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(run.pid()), &stopped, WSTOPPED | WEXITED), 0);
  EXPECT_EQ(stopped.si_code, CLD_STOPPED);
  ASSERT_TRUE(run.wait_for_output("[launch]: stopping the system, SIGCONT continues it"));
  const std::string pid = run.out().substr(run.out().find("process started with pid [") + 26);
  while (read_file("/proc/" + pid.substr(0, pid.find(']')) + "/stat").find(") T ") == std::string::npos) {
    ::sched_yield();
  }
  run.send_signal(SIGCONT);
  ASSERT_TRUE(run.wait_for_output("[launch]: continuing the system"));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[worker-1] cleaned up"));
}

// Nobody could continue it. If Ctrl-Z stopped it, Ctrl-C would do nothing.
TEST_F(Supervision, CtrlZDoesNothingToTheFirstProgramOfATerminal) {
  constexpr const char* kOnATerminal = R"py(
import os, pty, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], sys.argv[1:])
shown = b''
while b'ready' not in shown:
    shown += os.read(terminal, 4096)
os.write(terminal, b'\x1a\x03')
try:
    while os.read(terminal, 4096):
        pass
except OSError:
    pass
print('ended with', os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
)py";
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen" cmd="echo ready; exec sleep 1000"/>)xml");
  EXPECT_EQ(run_command({"python3", "-c", kOnATerminal, LAUNCH_PROGRAM, file}).out, "ended with 0\n");
}

TEST_F(Supervision, ACrashIsReportedWithItsLineAndTheRestGoesOn) {
  const std::string file = write(R"xml(<executable name="crasher" cmd="kill -SEGV $$" shell="true"/>
<executable name="other" cmd="echo fine" output="screen"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("exit code -11"));
  EXPECT_THAT(result.out,
              testing::ContainsRegex("\\[ERROR\\] \\[launch\\]: 1 process has failed:\n"
                                     "\\[ERROR\\] \\[launch\\]:   crasher-1: SIGSEGV.* after [0-9.]+ s, with "
                                     "[0-9.]+ s of processor time and [0-9.]+ MiB \\(.*:2:2\\)\n"));
  EXPECT_THAT(result.out, HasSubstr(file + ":2:2"));
  EXPECT_THAT(result.out, HasSubstr("[other-2] fine"));
}

TEST_F(Supervision, AMissingProgramIsReportedWithItsLineAndIsAFailure) {
  const std::string file = write(R"xml(<executable cmd="no-such-program-at-all"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("no-such-program-at-all"));
  EXPECT_THAT(result.out, HasSubstr(file + ":2:2"));
}

TEST_F(Supervision, FailuresCanBeAllowedAndIgnored) {
  const std::string file = write(R"xml(<arg name="allowed"/>
<executable name="a" shell="true" cmd="exit 4" allowed-exit-codes="$(var allowed)"/>)xml");
  const CommandResult allowed = run_command({LAUNCH_PROGRAM, file, "allowed:=4, SIGTERM"});
  EXPECT_EQ(allowed.exit_code, 0);
  EXPECT_THAT(allowed.out, HasSubstr("[INFO] [a-1]: process has finished with exit code 4, which is allowed [pid "));
  EXPECT_THAT(allowed.out, Not(HasSubstr("ERROR")));
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, file, "allowed:=5"}).exit_code, 3);
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "--ignore-failures", file, "allowed:=5"}).exit_code, 0);
  const CommandResult ignored = run_command(
      {.argv = {LAUNCH_PROGRAM, file, "allowed:=5"}, .environment = {{"OVERRIDE_LAUNCH_IGNORE_FAILURES", "1"}}});
  EXPECT_EQ(ignored.exit_code, 0);
  EXPECT_THAT(ignored.out, HasSubstr("[ERROR] [launch]: 1 process has failed:\n"));
}

TEST_F(Supervision, AMissingNodeStartsNothing) {
  const std::string file = write(R"xml(<executable cmd="echo started" output="screen"/>
<node pkg="demo_nodes" exec="pingg"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(file + ":3:30: error: executable 'pingg' not found on the libexec directory"));
  EXPECT_THAT(result.err, HasSubstr("did you mean 'ping'?"));
  EXPECT_THAT(result.out, Not(HasSubstr("started")));
}

TEST_F(Supervision, CtrlCInTheMiddleOfALargeStartStartsNoMore) {
  std::string actions;
  for (int i = 0; i < 1000; ++i) {
    actions += "<executable name=\"sleeper\" cmd=\"sleep 1000\"/>\n";
  }
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(actions)}});
  ASSERT_TRUE(run.wait_for_output("[sleeper-20]: process started")) << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, Not(HasSubstr("[sleeper-1000]: process started")));
}

TEST_F(Supervision, SigtermToTheLauncherEndsItsProcesses) {
  const std::string file =
      write(R"xml(<executable name="waiter" shell="true" output="screen" cmd="echo ready; exec cat"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[waiter-1] ready"));
  run.send_signal(SIGTERM);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.output_closed);
  EXPECT_THAT(result.out, HasSubstr("user interrupted with SIGTERM"));
}

TEST_F(Supervision, DescendantsDontSurvive) {
  const std::string file = write(R"xml(
    <executable name="parent" shell="true" output="screen" sigterm_timeout="0.1" sigkill_timeout="0.1"
                cmd="trap exit INT; (trap : INT TERM; echo ready; while :; do read x; done) &amp; wait"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[parent-1] ready"));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
  wait_until_all_have_gone();
}

// Daemons: they have a session of their own, their parent has died, and they hold the output of the process.
class Daemons : public Supervision {
 protected:
  // A launch of a process that starts a daemon, ended by Ctrl-C when the daemon says that it is ready.
  CommandResult end_launch_of(const std::string& daemon, const std::string& timeout) {
    write_file(sandbox_.directory() / "daemon.py",
               "import signal, sys, time\n" + daemon + "\nprint('ready', flush=True)\nwhile True: time.sleep(1000)\n");
    const std::string file = write("<executable name=\"parent\" shell=\"true\" output=\"screen\" sigterm_timeout=\"" +
                                   timeout + "\" sigkill_timeout=\"" + timeout + "\" cmd=\"setsid -f python3 " +
                                   (sandbox_.directory() / "daemon.py").string() + "; exec sleep 1000\"/>");
    RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
    EXPECT_TRUE(run.wait_for_output("[parent-1] ready")) << run.out() << run.err();
    run.send_signal(SIGINT);
    const CommandResult result = run.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0);
    wait_until_all_have_gone();
    return result;
  }

  const std::string left_ =
      "\\[WARNING\\] \\[launch\\]: parent-1 left 1 process running: python3 \\([0-9]+\\); ending it\n";
};

// The launcher can't reach a daemon through its group, and must not wait for it until all timeouts are over.
TEST_F(Daemons, AreEndedAsSoonAsTheProcessesHaveEnded) {
  const CommandResult result =
      end_launch_of("signal.signal(signal.SIGINT, lambda *_: (print('cleaned up', flush=True), sys.exit()))", "1000");
  EXPECT_THAT(result.out, testing::ContainsRegex(left_ + "\\[parent-1\\] cleaned up\n"));
}

TEST_F(Daemons, ThatIgnoreSignalsHaveTheirTimeoutsAndTheScreenSaysSo) {
  const CommandResult result =
      end_launch_of("for number in signal.SIGINT, signal.SIGTERM: signal.signal(number, signal.SIG_IGN)", "0.2");
  EXPECT_THAT(result.out,
              testing::ContainsRegex(
                  left_ + "\\[WARNING\\] \\[launch\\]: 1 process has not ended after SIGINT, sending SIGTERM: python3 "
                          "\\([0-9]+\\)\n"
                          "\\[WARNING\\] \\[launch\\]: 1 process has not ended after SIGTERM, sending SIGKILL: python3 "
                          "\\([0-9]+\\)\n"));
}

// lttng-ust and Fast DDS map memory there that has no pages yet, and a process that gets none dies by SIGBUS.
TEST_F(Supervision, NodesRunWhenTheSharedMemoryIsFull) {
  if (run_command({"unshare", "--mount", "mount", "-t", "tmpfs", "tmpfs", "/dev/shm"}).exit_code != 0) {
    GTEST_SKIP() << "skipped, because /dev/shm can't be replaced";
  }
  const std::string file = write(R"xml(<node pkg="demo_nodes" exec="pong"/>
    <node pkg="demo_nodes" exec="ping" output="screen" on_exit="shutdown"><param name="count" value="2"/></node>)xml");
  const CommandResult result =
      run_command({"unshare", "--mount", "sh", "-c",
                   "mount -t tmpfs -o size=4k tmpfs /dev/shm && head -c 4096 /dev/zero > /dev/shm/full && exec \"$@\"",
                   "sh", LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("[ping-2] tracetools: tracing is disabled, because /dev/shm is full\n"));
  EXPECT_THAT(result.out, HasSubstr("[rmw_fastrtps]: /dev/shm is full: messages to processes of this host take the way "
                                    "over UDP\n"));
}

TEST_F(Supervision, NothingSurvivesWhenTheLauncherIsKilled) {
  const std::string file = write(R"xml(
    <executable name="parent" shell="true" output="screen" cmd="echo ready; (read x) &amp; read x"/>)xml");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[parent-1] ready")) << run.out();
  run.send_signal(SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  wait_until_all_have_gone();
}

TEST_F(Supervision, TraceOptionRecordsAFileWithoutATrace) {
  const std::string file = write(R"xml(<executable cmd="true"/>)xml");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--trace", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch.trace]: trace is incomplete: no userspace event was recorded: no program "
                        "that ran has events of the session and was registered with the session daemon"));
  EXPECT_THAT(result.out,
              HasSubstr("writing tracing session to: " + sandbox_.trace_directory().string() + "/system-2"));
}

TEST_F(Supervision, TraceOptionLeavesAFileWithATraceAsItIs) {
  const std::string file = write(R"xml(<executable cmd="true"/><group><trace session-name="own"/></group>)xml");
  const CommandResult plan = run_command({LAUNCH_PROGRAM, "--trace", "--dry-run", file});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("1 process, 1 trace; nothing was started\n"));
  EXPECT_THAT(plan.out, HasSubstr("own"));
}

TEST_F(Supervision, LostEventsFailTheRunWhereTheFileSaysSo) {
  // The smallest buffers, and more events at once than they can hold: every malloc of a shell script that copies text.
  const std::string traced =
      R"xml(<trace session-name="$(var name)" events-ust="lttng_ust_libc:*" subbuffer-size-ust="4096"
 fail-on-loss="$(var fail)"/>
<executable cmd="python3 -c 'for i in range(300000): str(i).encode()*600'"/>)xml";
  const std::string file = write(R"xml(<arg name="name"/><arg name="fail"/>)xml" + traced);
  const CommandResult tolerant = run_command({LAUNCH_PROGRAM, file, "name:=a", "fail:=false"});
  EXPECT_EQ(tolerant.exit_code, 0) << tolerant.err;
  EXPECT_THAT(tolerant.out, HasSubstr("[WARNING] [launch.trace]: trace is incomplete: "));
  EXPECT_THAT(tolerant.out, HasSubstr(" events lost in ust channel ros2 with 4 sub-buffers of 4096 bytes"));
  const CommandResult strict = run_command({LAUNCH_PROGRAM, file, "name:=b", "fail:=true"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.err, HasSubstr("error: the trace of session 'b' is incomplete"));
  EXPECT_THAT(read_file(sandbox_.trace_directory() / "b" / "verdict.json"), HasSubstr("\"complete\": false"));
}

TEST_F(Supervision, AnErrorOfTracingStartsNothing) {
  const std::string file = write(R"xml(<trace session-name="taken"/>
<executable cmd="echo started" output="screen"/>)xml");
  ASSERT_EQ(run_command({LAUNCH_PROGRAM, file}).exit_code, 0);
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});  // its directory exists this time
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(file + ":2:2: error: tracing setup failed: "));
  EXPECT_THAT(result.err, HasSubstr("append-trace"));
  EXPECT_THAT(result.out, Not(HasSubstr("[echo-1] started")));
}

}  // namespace
