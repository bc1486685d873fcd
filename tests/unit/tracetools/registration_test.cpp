// SPDX-License-Identifier: Apache-2.0
// What a process misses until the session daemon has registered it, and how long it waits for that.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <list>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"
#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace {

using test_support::RunningCommand;
using tracing::EventCounts;
using Clock = std::chrono::steady_clock;

struct Registration : testing::Test {
  void SetUp() override { std::filesystem::create_directories(counters); }

  static void run(const std::vector<std::string>& argv) {
    const auto result = test_support::run_command(argv);
    ASSERT_EQ(result.exit_code, 0) << testing::PrintToString(argv) << result.out << result.err;
  }
  static void start_session() {
    run({"lttng", "create", "run", "--snapshot"});
    run({"lttng", "enable-event", "--userspace", "ros2:*"});
    run({"lttng", "start"});
    run({"lttng", "list", "--userspace"});  // the processes answer after their state dumps
  }
  test_support::Command program() const {
    return {
        .argv = {OBJECTS_ON_COMMAND},
        .environment = {{"TRACETOOLS_EVENT_COUNTERS", counters.string()}, {"TRACETOOLS_REGISTER_TIMEOUT", "60000"}}};
  }
  static void tell(RunningCommand& process, const std::string& line) {
    process.write(line + "\n");
    ASSERT_TRUE(process.wait_for_output(line + "\n")) << process.err();
  }
  std::vector<EventCounts> counts() const { return tracing::EventCounters(counters).read(); }

  test_support::Sandbox sandbox;
  std::filesystem::path counters = sandbox.directory() / "counters";
};

TEST_F(Registration, EventsBeforeTheFirstSessionAreMissedUnlessADumpHasThem) {
  run({"lttng-sessiond", "--daemonize"});
  RunningCommand process(program());
  tell(process, "make 1");
  tell(process, "take 3");
  start_session();
  tell(process, "take 2");
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
  ASSERT_EQ(counts().size(), 1u);
  const EventCounts counted = counts().front();
  EXPECT_GT(counted.reached, counted.begin);
  EXPECT_EQ(counted.missed, 3u);
  EXPECT_EQ(counted.events, (std::map<std::string, std::uint64_t>{{"ros2:rcl_take", 2}, {"ros2:rcl_timer_init", 1}}));
}

TEST_F(Registration, WithoutASessionEverythingIsMissed) {
  RunningCommand process(program());
  tell(process, "make 1");
  tell(process, "take 3");
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
  ASSERT_EQ(counts().size(), 1u);
  EXPECT_EQ(counts().front().reached, 0u);
  EXPECT_EQ(counts().front().missed, 4u);
  EXPECT_TRUE(counts().front().events.empty());
}

TEST_F(Registration, OfManyProcessesAtOnceIsWaitedFor) {
  run({"lttng-sessiond", "--daemonize"});
  start_session();
  std::list<RunningCommand> processes;
  constexpr std::size_t kProcesses = 40;
  for (std::size_t i = 0; i < kProcesses; ++i) {
    processes.emplace_back(program());
  }
  for (RunningCommand& process : processes) {
    tell(process, "take 1");
    process.close_input();
    EXPECT_EQ(process.wait().exit_code, 0) << process.err();
  }
  const std::vector<EventCounts> all = counts();
  EXPECT_EQ(all.size(), kProcesses);
  for (const EventCounts& counted : all) {
    EXPECT_NE(counted.reached, 0u) << counted.pid;
    EXPECT_EQ(counted.missed, 0u) << counted.pid;
    EXPECT_EQ(counted.total(), 1u) << counted.pid;
  }
}

// LTTng would wait for the minute that it is given.
TEST_F(Registration, AStoppedDaemonHoldsUpNobody) {
  NEEDS_WHAT_QEMU_LACKS("orphans do not become children of the sandbox here, as under QEMU");
  run({"lttng-sessiond", "--daemonize"});
  start_session();
  const pid_t daemon = tracing::session_daemon_pid();
  kill(daemon, SIGSTOP);
  ASSERT_EQ(waitpid(daemon, nullptr, WUNTRACED), daemon);  // it is an orphan now, so it is a child of the sandbox
  const Clock::time_point begin = Clock::now();
  RunningCommand process(program());
  tell(process, "take 3");
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));
  RecordProperty("milliseconds", static_cast<int>((Clock::now() - begin) / std::chrono::milliseconds(1)));
  kill(daemon, SIGCONT);
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
  EXPECT_EQ(counts().front().missed, 3u);
}

TEST_F(Registration, OfAProcessWithATimeoutOfItsOwnIsLeftToLttng) {
  RunningCommand process(
      {.argv = {"sh", "-c", std::string(OBJECTS_ON_COMMAND) + "; env"},
       .environment = {{"LTTNG_UST_REGISTER_TIMEOUT", "7"}, {"TRACETOOLS_REGISTER_TIMEOUT", "60000"}}});
  tell(process, "make 1");
  process.close_input();
  EXPECT_NE(process.wait().out.find("LTTNG_UST_REGISTER_TIMEOUT=7\n"), std::string::npos);
}

TEST_F(Registration, ForksThatFireNothingLeaveNothing) {
  run({"lttng-sessiond", "--daemonize"});
  start_session();
  RunningCommand process(program());
  tell(process, "take 1");
  tell(process, "fork 300");
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
  EXPECT_EQ(counts().size(), 1u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(counters), {}), 1);
}

}  // namespace
