// SPDX-License-Identifier: Apache-2.0
// Kernel events recorded by LTTng's own modules. Runs in a guest that has them: `./dev test-kernel`.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class KernelModules : public testing::Test {
 protected:
  void SetUp() override {
    if (run_command({"modprobe", "lttng-tracer"}).exit_code != 0) {
      GTEST_SKIP() << "skipped, because LTTng's kernel modules are not installed here";
    }
  }

  std::string write(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path;
  }

  CommandResult launch(const std::string& actions) const {
    return run_command({.argv = {LAUNCH_PROGRAM, write(actions)}}, std::chrono::seconds(120));
  }

  static std::string babeltrace(const fs::path& directory) {
    const CommandResult read = run_command({.argv = {"babeltrace2", directory}}, std::chrono::seconds(60));
    EXPECT_EQ(read.exit_code, 0) << read.err;
    EXPECT_EQ(read.err, "") << "it tells of losses there";
    return read.out;
  }

  Sandbox sandbox_;
};

// Checks that the events of a processor come from the thread that it has switched to.
TEST_F(KernelModules, SchedSwitchesAndEventsOfNodesStandInOneOrderWithTheRightThreads) {
  const CommandResult result = launch(R"xml(
    <trace session-name="run" events-kernel="sched_switch sched_process_exec" syscalls="exit_group"
           subbuffer-size-kernel="1048576"/>
    <node pkg="demo_nodes" exec="pong"/>
    <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="5"/></node>)xml");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("trace is complete: no events lost"), Not(HasSubstr("tracefs"))));

  const fs::path directory = sandbox_.trace_directory() / "run";
  const RecordedTrace trace = read_trace(directory);
  EXPECT_EQ(trace.losses, 0u);
  EXPECT_TRUE(std::is_sorted(trace.events.begin(), trace.events.end(),
                             [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; }));
  std::map<std::int64_t, std::int64_t> running;  // thread on each processor
  std::set<std::string> nodes;
  int checked = 0;
  int elsewhere = 0;
  for (const RecordedEvent& event : trace.events) {
    if (event.name == "sched_switch") {
      // A thread that has just ended has no number any more.
      EXPECT_THAT(event.vtid, AnyOf(0, static_cast<std::int64_t>(event.number("prev_tid"))));
      running[event.cpu_id] = static_cast<std::int64_t>(event.number("next_tid"));
    } else if (event.name.starts_with("ros2:") && running.contains(event.cpu_id)) {
      ++checked;
      if (running[event.cpu_id] != event.vtid) {
        ++elsewhere;
      }
      if (event.name == "ros2:rcl_node_init") {
        nodes.insert(event.text("node_name"));
      }
    }
  }
  EXPECT_EQ(nodes, (std::set<std::string>{"ping", "pong"}));
  EXPECT_GT(checked, 200);
  EXPECT_EQ(elsewhere, 0) << "of " << checked;

  const std::string text = babeltrace(directory);
  const std::size_t exec = text.find("/demo_nodes/ping\"");
  const std::size_t init = text.find("node_name = \"ping\"");
  const std::size_t exit = text.rfind("syscall_entry_exit_group: ");
  ASSERT_NE(exec, std::string::npos);
  ASSERT_NE(init, std::string::npos);
  EXPECT_LT(exec, init);
  EXPECT_LT(init, exit);
}

TEST_F(KernelModules, AttributesOfTheKernelChannelAreAsTheDaemonListsThem) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(R"xml(
    <trace session-name="run" events-ust="" events-kernel="'sched_switch if next_tid != 0' sched_wakeup"
           syscalls="openat" context-fields="procname tid nice" subbuffer-size-kernel="262144" launch-events="false">
      <channel name="rest" syscalls="*" subbuffer-size="524288" subbuffer-count="8" read-timer="100000" overwrite="true"/>
    </trace>
    <executable name="lasting" cmd="sleep 1000"/>)xml")}});
  ASSERT_TRUE(run.wait_for_output("[lasting-1]: process started", std::chrono::seconds(60))) << run.out() << run.err();
  const std::string listed = run_command({"lttng", "list", "run"}).out;
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(std::chrono::seconds(60)).exit_code, 0) << run.out() << run.err();

  // The newest one comes first.
  const std::size_t second = listed.find("- kchan: [enabled]");
  ASSERT_NE(second, std::string::npos) << listed;
  EXPECT_THAT(listed.substr(0, second),
              AllOf(HasSubstr("=== Domain: Linux kernel ==="), HasSubstr("- rest: [enabled]"),
                    HasSubstr("Event-loss mode:  overwrite"), HasSubstr("Sub-buffer size:  524288 bytes"),
                    HasSubstr("Sub-buffer count: 8"), HasSubstr("Read timer:       100000 us"),
                    HasSubstr("* (type:syscall) [enabled]")));
  EXPECT_THAT(listed.substr(second),
              AllOf(HasSubstr("Event-loss mode:  discard"), HasSubstr("Sub-buffer size:  262144 bytes"),
                    HasSubstr("Sub-buffer count: 2"), HasSubstr("Read timer:       200 us"),
                    HasSubstr("openat (type:syscall) [enabled]"), HasSubstr("sched_wakeup (loglevel"),
                    ContainsRegex("sched_switch .*\\[filter: 'next_tid != 0'\\]")));
  const std::string text = babeltrace(sandbox_.trace_directory() / "run");
  EXPECT_THAT(text, AllOf(HasSubstr("nice = "), HasSubstr("syscall_entry_")));
}

TEST_F(KernelModules, ASnapshotHoldsKernelAndUserspace) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write(R"xml(
    <trace session-name="run" snapshot-on-crash="true" events-kernel="sched_switch"/>
    <node pkg="demo_nodes" exec="talker"/>
    <executable name="unlucky" cmd="sh -c 'kill -SEGV $$$$'">
      <depends_on process="talker" condition="output" pattern="Publishing"/>
    </executable>)xml")}});
  ASSERT_TRUE(run.wait_for_output("snapshot written to: ", std::chrono::seconds(90))) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(std::chrono::seconds(60)).exit_code, 3) << run.out() << run.err();
  const std::string text = babeltrace(sandbox_.trace_directory() / "run");
  EXPECT_THAT(text, AllOf(HasSubstr("sched_switch: "), HasSubstr("ros2:")));
}

TEST_F(KernelModules, UnknownNamesAloneAreAnErrorAtTheTraceAndLeaveNothing) {
  const CommandResult event = launch(R"xml(<trace session-name="run" events-kernel="sched_swich"/>)xml");
  EXPECT_EQ(event.exit_code, 1);
  EXPECT_THAT(event.err, AllOf(HasSubstr(":2:2: error: tracing setup failed: the kernel has no event 'sched_swich'\n"),
                               HasSubstr("= help: did you mean `sched_switch`?")));
  EXPECT_THAT(run_command({"lttng", "list"}).out, HasSubstr("Currently no available recording session"));
  const CommandResult beside =
      launch(R"xml(<trace session-name="run" events-kernel="sched_* sched_swich" syscalls="openat sys_read"/>)xml");
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_THAT(beside.out, HasSubstr("not recorded, for the kernel has no event 'sched_swich' (did you mean "
                                    "`sched_switch`?), no system call 'sys_read' ("));
}

// LTTng's modules 2.13 take the kernel down with it.
TEST_F(KernelModules, TheContextFieldPrioIsRefused) {
  const CommandResult result =
      launch(R"xml(<trace session-name="run" events-ust="" events-kernel="sched_switch" context-fields="prio"/>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("context field 'prio' would crash this kernel: LTTng's modules 2.13."));
  EXPECT_THAT(run_command({"lttng", "list"}).out, HasSubstr("Currently no available recording session"));
}

TEST_F(KernelModules, EventsAndSystemCallsAreListed) {
  run_command({"lttng-sessiond", "--daemonize"});
  const CommandResult result = run_command({LAUNCH_PROGRAM, "trace", "events"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("\n  sched_switch\n"), HasSubstr(" system calls\n")));
}

}  // namespace
