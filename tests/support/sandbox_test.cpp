// SPDX-License-Identifier: Apache-2.0
#include "tests/support/sandbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/command.hpp"

namespace {

using std::chrono::milliseconds;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using test_support::Sandbox;

TEST(Sandbox, GivesDirectoriesOfItsOwnAndTakesThemAway) {
  setenv("ROS_DISTRO", "some", 1);
  const std::string home = getenv("HOME");
  std::filesystem::path directory;
  {
    const Sandbox sandbox;
    directory = sandbox.directory();
    for (const char* variable : {"HOME", "LTTNG_HOME", "ROS_HOME", "ROS_LOG_DIR", "ROS_TRACE_DIR", "TMPDIR"}) {
      EXPECT_TRUE(std::string(getenv(variable)).starts_with(directory.string())) << variable;
      EXPECT_TRUE(std::filesystem::is_directory(getenv(variable))) << variable;
    }
    EXPECT_EQ(getenv("ROS_DISTRO"), nullptr);
    EXPECT_NE(getenv("ROS_DOMAIN_ID"), nullptr);
  }
  EXPECT_FALSE(std::filesystem::exists(directory));
  EXPECT_EQ(getenv("HOME"), home);
  EXPECT_STREQ(getenv("ROS_DISTRO"), "some");
  EXPECT_EQ(getenv("ROS_DOMAIN_ID"), nullptr);
  unsetenv("ROS_DISTRO");
}

TEST(Sandbox, HidesTheMachinesRunDirectoryAndNetwork) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because only root gets namespaces";
  }
  for (int round = 0; round < 2; ++round) {
    const Sandbox sandbox;
    EXPECT_EQ(sandbox.not_isolated(), "");
    EXPECT_TRUE(std::filesystem::is_empty("/run"));
    EXPECT_TRUE(std::filesystem::is_empty("/dev/shm"));
    std::ofstream("/dev/shm/mine") << "x";
    const std::string interfaces = test_support::read_file("/proc/net/dev");
    EXPECT_THAT(interfaces, testing::HasSubstr("lo:"));
    EXPECT_EQ(std::count(interfaces.begin(), interfaces.end(), ':'), 1);
    EXPECT_THAT(test_support::read_file("/proc/net/route"), testing::HasSubstr("lo\t000000E0"));
  }
  EXPECT_FALSE(std::filesystem::exists("/dev/shm/mine"));
}

TEST(Sandbox, KillsWhatIsLeftAndNamesIt) {
  Sandbox sandbox;
  // The shell ends at once. It leaves a child and a grandchild as orphans, which have its name until they exec.
  const CommandResult shell = run_command({"sh", "-c", "setsid sleep 1000 & (sleep 1001 & ) ; echo left"});
  EXPECT_EQ(shell.out, "left\n");
  EXPECT_FALSE(shell.output_closed);
  EXPECT_THAT(sandbox.end_processes(), testing::UnorderedElementsAre(testing::MatchesRegex("(sh|setsid|sleep) [0-9]+"),
                                                                     testing::MatchesRegex("(sh|sleep) [0-9]+")));
  EXPECT_TRUE(sandbox.end_processes().empty());
}

TEST(Sandbox, FailsTheTestThatLeavesAProcess) {
  EXPECT_NONFATAL_FAILURE(
      {
        const Sandbox sandbox;
        run_command({"sh", "-c", "sleep 1000 &"});
      },
      "the test left a process behind: s");
}

TEST(Sandbox, LeavesLttngsDaemonsOutOfItsComplaints) {
  Sandbox sandbox;
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  EXPECT_EQ(run_command({"lttng", "list"}).exit_code, 0);
  EXPECT_TRUE(sandbox.end_processes().empty());
  EXPECT_EQ(run_command({"lttng", "list"}).exit_code, 1);
}

TEST(Command, GivesOutputAndExitCode) {
  const CommandResult result = run_command({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
  EXPECT_TRUE(result.output_closed);
  EXPECT_FALSE(result.timed_out);
}

TEST(Command, TakesInputEnvironmentAndDirectory) {
  const CommandResult result = run_command(
      {.argv = {"sh", "-c", "cat; echo $VARIABLE; pwd"}, .environment = {{"VARIABLE", "value"}}, .directory = "/"},
      test_support::kCommandTimeout, "input\n");
  EXPECT_EQ(result.out, "input\nvalue\n/\n");
}

TEST(Command, ReadsMoreThanAPipeHolds) {
  EXPECT_EQ(run_command({"head", "-c", "1000000", "/dev/zero"}).out.size(), 1000000u);
}

TEST(Command, IsKilledWhenItsTimeIsOver) {
  const CommandResult result = run_command(Command{.argv = {"sleep", "1000"}}, milliseconds(20));
  EXPECT_TRUE(result.timed_out);
  EXPECT_EQ(result.signal, SIGKILL);
  EXPECT_EQ(result.exit_code, -1);
}

TEST(Command, WaitsForOutputAndTakesSignals) {
  RunningCommand command(
      {.argv = {"sh", "-c", "trap 'echo caught; exit 5' USR1; echo ready; while read line; do :; done"}});
  EXPECT_TRUE(command.wait_for_output("ready\n"));
  EXPECT_FALSE(command.wait_for_output("never", milliseconds(20)));
  command.send_signal(SIGUSR1);
  command.write("go on\n");
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.out, "ready\ncaught\n");
}

TEST(Command, WaitForOutputEndsWithTheProgram) {
  RunningCommand command({.argv = {"true"}});
  EXPECT_FALSE(command.wait_for_output("never"));
  EXPECT_EQ(command.wait().exit_code, 0);
}

TEST(Command, ThatDoesNotExistThrows) {
  EXPECT_THROW(run_command({"no-such-program-anywhere"}), std::system_error);
}

}  // namespace
