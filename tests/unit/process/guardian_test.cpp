// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "guardian_fixture.hpp"

namespace launch {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

// Leaves a process that has a session of its own, ignores SIGINT, and whose parent has died. The shell would let it
// ignore SIGINT anyway, because it starts it in the background, but it may tell its number before.
const std::string kDaemon =
    "pid=$(setsid sh -c 'trap \"\" INT; sleep 1000 >/dev/null 2>&1 </dev/null & echo $!'); echo $pid; ";

TEST_F(GuardianTest, EndsAllProcessesOfALauncherThatIsKilled) {
  start({kSleeper, kSleeper, kSleeper}, 3);
  EXPECT_TRUE(runs(shells_[0]) && runs(shells_[1]) && runs(shells_[2]));
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL) << "it ends as the launcher did";
  for (const UniqueFd& shell : shells_) {
    EXPECT_FALSE(runs(shell));
  }
  expect_nothing_left();
}

TEST_F(GuardianTest, AsksWithEachSignalForTheTimeOfTheProcess) {
  const std::string told = directory.path() + "/told";
  start({"--timeouts", "300", "300",
         fmt::format("trap 'echo INT >> {0}' INT; trap 'echo TERM >> {0}' TERM; echo ready; "
                     "while :; do sleep 0.01; done",
                     told)},
        1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(told), "INT\nTERM\n");
  EXPECT_FALSE(runs(shells_[0]));
}

TEST_F(GuardianTest, GivesAProcessItsWholeTime) {
  const std::string done = directory.path() + "/done";
  start({"--timeouts", "1000000", "0",
         fmt::format("trap 'sleep 0.3; echo clean > {}; exit' INT; echo ready; while :; do sleep 0.01; done", done)},
        1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, ReadsOutputToTheEnd) {
  const std::string log = directory.path() + "/launch.log";
  std::ofstream(log) << "";
  // More than a pipe holds. A shell whose output nobody reads dies of SIGPIPE.
  start(
      {"--timeouts", "1000000", "0", "--log", log,
       "trap 'seq 1 30000; echo the last words >&2; printf begun; exit' INT; echo ready; while :; do sleep 0.01; done"},
      1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  const std::string text = read_file(log);
  EXPECT_THAT(text, HasSubstr(" [ERROR] [launch]: the launcher was ended by SIGKILL: ending "));
  EXPECT_THAT(text, HasSubstr(" [shell-1] 1\n"));
  EXPECT_THAT(text, HasSubstr(" [shell-1] 30000\n"));
  EXPECT_THAT(text, HasSubstr(" [shell-1] the last words\n"));
  EXPECT_THAT(text, HasSubstr(" [shell-1] begun\n"));
}

TEST_F(GuardianTest, EndsWhatHasLeftTheGroupAndTheSession) {
  start({"--timeouts", "100", "100", kDaemon + kDaemon + "exec sleep 1000"}, 1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(GuardianTest, ContinuesAStoppedProcess) {
  const std::string done = directory.path() + "/done";
  start(
      {"--timeouts", "1000000", "0",
       fmt::format("trap 'echo clean > {}; exit' INT; echo ready; kill -STOP $$; while :; do sleep 0.01; done", done)},
      1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, PassesTheExitCodeOn) {
  start({"--exit", "7"}, 0);
  EXPECT_EQ(end(), 7);
  expect_nothing_left();
}

TEST_F(GuardianTest, PassesSignalsToTheLauncher) {
  start({}, 0);
  ::kill(guardian, SIGTERM);
  EXPECT_EQ(end(), -SIGTERM);
}

TEST_F(GuardianTest, TellsOfWhatALauncherLeavesAtItsOrdinaryEnd) {
  const std::string log = directory.path() + "/launch.log";
  std::ofstream(log) << "";
  start({"--timeouts", "100", "60000", "--log", log, "--exit", "0", kDaemon + "exec sleep 1000"}, 1);
  EXPECT_EQ(end(), 0);
  EXPECT_THAT(read_file(log), MatchesRegex("[0-9.]+ \\[WARNING\\] \\[launch\\]: shell-1 left 2 processes running: "
                                           "(sh|sleep) \\([0-9]+\\), (sh|sleep) \\([0-9]+\\); ending them\n"
                                           "[0-9.]+ \\[WARNING\\] \\[launch\\]: 1 process has not ended after SIGINT, "
                                           "sending SIGTERM: sleep \\([0-9]+\\)\n"))
      << "a shell lets what it starts in the background ignore SIGINT";
  expect_nothing_left();
}

TEST_F(GuardianTest, LeavesWhatIsMeantToGoOn) {
  start({"--timeouts", "100", "100", "--leave", "--exit", "0", kDaemon + "exec sleep 1000"}, 1);
  EXPECT_EQ(end(), 0);
  EXPECT_FALSE(runs(shells_[0])) << "it has no session of its own";
  pid_t left = 0;
  while ((left = ::waitpid(-1, nullptr, WNOHANG)) > 0) {
  }
  EXPECT_EQ(left, 0) << "there is a child that runs";
  std::ifstream children(fmt::format("/proc/self/task/{}/children", ::getpid()));
  for (pid_t child; children >> child;) {
    ::kill(child, SIGKILL);
  }
  expect_nothing_left();
}

TEST_F(GuardianTest, LeavesEarlierChildrenAlone) {
  ProcessSpec spec;
  spec.name = "test";
  spec.argv = {"sh", "-c", fmt::format("sleep 1000 & echo $!; exec {} {} --exit 0", DOOMED_LAUNCHER, LAUNCH_GUARDIAN)};
  spec.environment = {{"PATH", "/usr/bin:/bin"}};
  run = runner->spawn(spec);
  const pid_t earlier = read_pid();
  guardian = read_pid();
  launcher = read_pid();
  ::kill(launcher, SIGUSR1);
  EXPECT_EQ(end(), 0);
  EXPECT_EQ(::kill(earlier, 0), 0);
  ::kill(earlier, SIGKILL);
  expect_nothing_left();
}

TEST_F(GuardianTest, CleansUpAfterTheProcessesHaveEndedTheLastCommandFirst) {
  const std::string done = directory.path() + "/done";
  start({"--clean-up", "echo 'first one' >> " + done, "--forgotten", "echo no >> " + done, "--clean-up",
         fmt::format("kill -0 -$(head -n 3 {0}.pids | tail -n 1) 2> /dev/null || echo ended >> {0}", done),
         fmt::format("echo 0 > {0}.pids; echo 0 >> {0}.pids; echo $$ >> {0}.pids; ", done) + kSleeper},
        1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(done), "ended\nfirst one\n");
}

TEST_F(GuardianTest, ACleanUpThatGetsOnHasItsTime) {
  const std::string done = directory.path() + "/done";
  start({"--clean-up",
         fmt::format("end=$(($(date +%s) + 12)); while [ $(date +%s) -lt $end ]; do sleep 0.1; done; echo clean > {}",
                     done),
         kSleeper},
        1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, ACleanUpIsNotCutShortByWhatAsksForAnEnd) {
  const std::string done = directory.path() + "/done";
  start({"--clean-up",
         fmt::format("for signal in HUP INT QUIT TERM; do kill -s $signal $$; done; echo clean > {}", done), kSleeper},
        1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, ACleanUpThatHangsIsKilled) {
  const std::string log = directory.path() + "/launch.log";
  std::ofstream(log) << "";
  start({"--log", log, "--clean-up", "exec sleep 1000", kSleeper}, 1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_THAT(read_file(log), HasSubstr("'/bin/sh -c exec sleep 1000' takes too long: killing it"));
}

TEST_F(GuardianTest, TheSpareEndsWhatLauncherAndGuardianLeaveWhenBothAreKilled) {
  const std::string done = directory.path() + "/done";
  start({"--timeouts", "100", "100", "--clean-up", "echo clean > " + done, kDaemon + "exec sleep 1000", kSleeper}, 2);
  wait_for_spare();
  ::kill(launcher, SIGKILL);
  ::kill(guardian, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, TheLauncherIsToldWhenTheGuardianIsKilled) {
  start({"--timeouts", "100", "100", kDaemon + "exec sleep 1000"}, 1);
  wait_for_spare();
  ::kill(guardian, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();  // SIGTERM has ended the launcher, and the spare the rest
}

TEST_F(GuardianTest, ALauncherThatHasLostGuardianAndSpareStartsASpareAtItsEnd) {
  const std::string done = directory.path() + "/done";
  start({"--timeouts", "100", "100", "--end-by-sigterm", "--clean-up", "echo clean > " + done,
         kDaemon + "exec sleep 1000", kSleeper},
        2);
  const pid_t spare = wait_for_spare();
  ::kill(guardian, SIGSTOP);  // or else it would start another spare
  ::kill(spare, SIGKILL);
  ::kill(guardian, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
  EXPECT_EQ(read_file(done), "clean\n");
}

TEST_F(GuardianTest, AStoppedGuardianGoesOnWhenTheLauncherIsKilled) {
  start({kSleeper}, 1);
  wait_for_spare();
  ::kill(guardian, SIGSTOP);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(GuardianTest, HasANewSpareWhenTheSpareWasKilled) {
  start({kSleeper}, 1);
  const pid_t first = wait_for_spare();
  ::kill(first, SIGKILL);
  const pid_t second = wait_for_spare(first);
  EXPECT_EQ(::getsid(second), second) << "Ctrl-C does not reach it";
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(GuardianTest, ReapsOrphans) {
  start({"--timeouts", "0", "0", "(setsid sh -c 'echo $$' &) ; sleep 1000 & wait"}, 1);
  // The line of the orphan is the one that the shell was waited for. It ends, and no zombie stays.
  const pid_t spare = wait_for_spare();
  while (children(spare) != std::vector<pid_t>{launcher}) {
    ::sched_yield();
  }
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
}

TEST_F(GuardianTest, SaysWhichProgramIsMissing) {
  ProcessSpec spec;
  spec.name = "test";
  spec.argv = {DOOMED_LAUNCHER, "/nowhere/launch-guardian"};
  run = runner->spawn(spec);
  EXPECT_EQ(end(), 1);
  std::string text(200, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(run.err.get(), text.data(), text.size()))));
  EXPECT_EQ(text, "launch: error: cannot start '/nowhere/launch-guardian': No such file or directory\n");
}

}  // namespace
}  // namespace launch
