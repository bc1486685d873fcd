// SPDX-License-Identifier: Apache-2.0
// launch-guardian and processes that are hard to find or to end (hostile_process.cpp), with guardians and launchers
// that are killed, stopped and traced.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <string>
#include <tuple>

#include "guardian_fixture.hpp"

namespace launch {
namespace {

using testing::HasSubstr;

char state_of(pid_t process) {
  const std::string stat = read_file(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = stat.rfind(')');
  return name_end + 2 < stat.size() ? stat[name_end + 2] : 'X';
}

const std::string kHostile = "exec " HOSTILE_PROCESS;

class HostileProcesses : public GuardianTest {
 protected:
  // A launcher that one of its processes traces.
  void start_traced() {
    start({"--timeouts", "100", "100", kHostile + " tracer"}, 1);
    ::kill(shell_pids[0], SIGUSR2);
    while (state_of(launcher) != 't') {
      ::sched_yield();
    }
  }
};

TEST_F(HostileProcesses, EndsAProcessWhoseMainThreadHasEnded) {
  start({"--timeouts", "100", "100", kHostile + " leaderless", kHostile + " leaderless-daemon"}, 2);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(HostileProcesses, TellsAProcessWhoseMainThreadHasEndedByItsMark) {
  const std::string log = directory.path() + "/launch.log";
  std::ofstream(log) << "";
  start({"--log", log, "--exit", "0", kHostile + " leaderless-daemon"}, 1);
  EXPECT_EQ(end(), 0);
  EXPECT_THAT(read_file(log), HasSubstr("[WARNING] [launch]: shell-1 left "));
  expect_nothing_left();
}

bool has_pending(pid_t process, int signal) {
  const std::string status = read_file(fmt::format("/proc/{}/status", process));
  const std::size_t pending = status.find("\nShdPnd:\t");
  return pending != std::string::npos &&
         ((std::stoull(status.substr(pending + 9), nullptr, 16) >> (signal - 1)) & 1) != 0;
}

// What a daemon does to hide, and which two of the three are killed.
using Kill = std::tuple<const char*, const char*>;
std::string name_of_kill(const testing::TestParamInfo<Kill>& test) {
  std::string name = std::string(std::get<0>(test.param)) + std::get<1>(test.param);
  std::erase(name, '-');
  return name;
}

class AnyTwo : public HostileProcesses, public testing::WithParamInterface<Kill> {};

TEST_P(AnyTwo, MayBeKilledWhateverADaemonHides) {
  const auto [shape, killed] = GetParam();
  start({"--timeouts", "100", "100", kHostile + " " + shape}, 1);
  const std::map<char, pid_t> pids = {{'G', guardian}, {'S', wait_for_spare()}, {'L', launcher}};
  for (const char* who = killed; *who != '\0'; ++who) {
    ::kill(pids.at(*who), SIGKILL);
  }
  end();
  expect_nothing_left();
}

INSTANTIATE_TEST_SUITE_P(Hidden, AnyTwo,
                         testing::Combine(testing::Values("empty-daemon", "hidden-daemon", "leaderless-daemon",
                                                          "endless"),
                                          testing::Values("G", "L", "GL", "LG", "LS", "SL")),
                         name_of_kill);

TEST_F(HostileProcesses, UsesTheTimeoutsOfAProcessWhoseEnvironmentTellsNothing) {
  const std::string told = directory.path() + "/told";
  start({"--timeouts", "300", "1000000", kHostile + " empty " + told}, 1);
  const auto begin = std::chrono::steady_clock::now();
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  EXPECT_EQ(read_file(told), "INT\nTERM\n");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << "those are the timeouts of others";
}

// Each process lives for two milliseconds, and has started the next one before it ends.
TEST_F(HostileProcesses, IsNotDeceivedByALookThatFindsNothing) {
  start({"--timeouts", "20", "20", "--exit", "0", kHostile + " endless"}, 1);
  EXPECT_EQ(end(), 0);
  expect_nothing_left();
}

TEST_F(HostileProcesses, ContinuesALauncherThatIsStoppedWhenItIsAskedToEnd) {
  start({kSleeper}, 1);
  ::kill(launcher, SIGSTOP);
  ::kill(guardian, SIGTERM);
  EXPECT_EQ(end(), -SIGTERM);
  expect_nothing_left();
}

TEST_F(HostileProcesses, EndsALauncherThatAProcessOfItsTraces) {
  start_traced();
  const UniqueFd ended = open_process(guardian);
  for (pollfd wait{ended.get(), POLLIN, 0}; ::poll(&wait, 1, 1100) == 0;) {
    ::kill(guardian, SIGTERM);  // the third one counts
  }
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(HostileProcesses, EndsALauncherThatHasTakenTheSignalAndIsTracedThen) {
  before = {"/usr/bin/env", "--ignore-signal=INT"};  // nothing stays pending
  start({"--timeouts", "100", "100", kHostile + " tracer"}, 1);
  ::kill(guardian, SIGINT);
  while (has_pending(guardian, SIGINT)) {
    ::sched_yield();
  }
  ::kill(shell_pids[0], SIGUSR2);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

TEST_F(HostileProcesses, TheSpareEndsALauncherThatAProcessOfItsTraces) {
  start_traced();
  ::kill(guardian, SIGKILL);
  end();
  ::kill(launcher, SIGKILL);  // it cannot be waited for before its tracer has ended
  expect_nothing_left();
}

TEST_F(HostileProcesses, ASpareBesideEndsALauncherThatAProcessOfItsTraces) {
  start({"--timeouts", "100", "100", kHostile + " tracer"}, 1);
  const pid_t spare = wait_for_spare();
  ::kill(shell_pids[0], SIGUSR2);
  while (state_of(launcher) != 't') {
    ::sched_yield();
  }
  ::kill(spare, SIGKILL);
  wait_for_spare(spare);
  ::kill(guardian, SIGKILL);
  end();
  expect_nothing_left();
}

TEST_F(HostileProcesses, ASpareThatIsStoppedGoesOn) {
  start({"--timeouts", "100", "100", kSleeper}, 1);
  const pid_t spare = wait_for_spare();
  ::kill(spare, SIGSTOP);
  while (has_pending(spare, SIGSTOP) || state_of(spare) == 'T') {
    ::sched_yield();
  }
  ::kill(launcher, SIGKILL);
  ::kill(guardian, SIGKILL);
  end();
  expect_nothing_left();
}

TEST_F(HostileProcesses, AGuardianThatIsStoppedGoesOn) {
  start({kSleeper}, 1);
  const pid_t spare = wait_for_spare();
  ::kill(guardian, SIGSTOP);
  siginfo_t change{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(guardian), &change, WSTOPPED | WCONTINUED | WNOWAIT), 0);
  while (state_of(guardian) == 'T') {
    ::sched_yield();
  }
  ::kill(spare, SIGKILL);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

// What has begun to end the processes may be killed as well, when the launcher has ended for the lack of the guardian.
TEST_F(HostileProcesses, AnotherSpareGoesOnWhenTheSpareIsKilledWhileItEndsTheRest) {
  const std::string told = directory.path() + "/told";
  start({"--timeouts", "300", "300", kHostile + " plain-daemon " + told}, 1);
  const pid_t spare = wait_for_spare();
  ::kill(guardian, SIGKILL);
  while (read_file(told) != "INT\n") {
    ::sched_yield();
  }
  ::kill(spare, SIGKILL);
  end();
  expect_nothing_left();
  EXPECT_EQ(read_file(told), "INT\nINT\nTERM\n");
}

TEST_F(HostileProcesses, AnotherSpareStandsByWhenTheSpareIsKilledWhileTheGuardianEndsTheRest) {
  const std::string told = directory.path() + "/told";
  start({"--timeouts", "300", "300", kHostile + " plain-daemon " + told}, 1);
  const pid_t spare = wait_for_spare();
  ::kill(launcher, SIGKILL);
  while (read_file(told) != "INT\n") {
    ::sched_yield();
  }
  ::kill(spare, SIGKILL);
  wait_for_spare(spare);
  ::kill(guardian, SIGKILL);
  end();
  expect_nothing_left();
}

class BothGuardians : public HostileProcesses, public testing::WithParamInterface<Kill> {};

// The daemon may have lost its parent a moment ago.
TEST_P(BothGuardians, MayBeKilledAtOnceWhateverADaemonHides) {
  const auto [shape, killed] = GetParam();
  start({"--timeouts", "100", "100", "--end-by-sigterm", kHostile + " " + shape}, 1);
  const std::map<char, pid_t> pids = {{'G', guardian}, {'S', wait_for_spare()}};
  for (const char* who = killed; *who != '\0'; ++who) {
    ::kill(pids.at(*who), SIGKILL);
  }
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
}

INSTANTIATE_TEST_SUITE_P(Hidden, BothGuardians,
                         testing::Combine(testing::Values("empty-daemon", "hidden-daemon", "leaderless-daemon"),
                                          testing::Values("GS", "SG")),
                         name_of_kill);

}  // namespace
}  // namespace launch
