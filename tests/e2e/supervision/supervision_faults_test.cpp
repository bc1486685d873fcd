// SPDX-License-Identifier: Apache-2.0
// Random trees of processes, and a launcher and a guardian that are killed at random moments: nothing survives.
//
// 12 tests of 17 rounds are 204 random moments. FAULT_ROUNDS=200 makes each test longer. A failure names the seed of
// its round.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <tuple>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using std::chrono::microseconds;
using std::chrono::seconds;

constexpr seconds kPatience{60};

enum class Fault { kLauncher, kGuardian, kLauncherFirst, kGuardianFirst, kGroup, kInterrupt };

int rounds() {
  const char* const given = std::getenv("FAULT_ROUNDS");
  return given == nullptr ? 17 : std::atoi(given);
}

pid_t first_child(pid_t parent) {
  const std::string number = std::to_string(parent);
  std::ifstream children("/proc/" + number + "/task/" + number + "/children");
  pid_t child = -1;
  children >> child;
  return child;
}

// The spare guardian is the child of the guardian, which the user has started, and the launcher is the child of the
// spare.
pid_t launcher_below(pid_t guardian) {
  return first_child(first_child(guardian));
}

// Busy: a sleep would be as long as the timer of the machine wants it.
void wait_for(microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
  }
}

// All that the launch has started ends within the patience and becomes our child on the way, or that of a guardian.
bool nothing_is_left() {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  sigset_t child;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, nullptr);
  while (std::chrono::steady_clock::now() < deadline) {
    const pid_t reaped = waitpid(-1, nullptr, WNOHANG);
    if (reaped < 0 && errno == ECHILD) {
      return true;
    }
    const timespec some_time{.tv_sec = 0, .tv_nsec = 20'000'000};
    if (reaped == 0) {
      sigtimedwait(&child, nullptr, &some_time);
    }
  }
  return false;
}

class SupervisionFaults : public testing::TestWithParam<std::tuple<Fault, bool>> {
 protected:
  // A launch of some random trees.
  std::string write(std::mt19937& random, int trees) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    std::string text = "<launch>\n";
    for (int i = 0; i < trees; ++i) {
      text += "<executable cmd=\"" RANDOM_TREE " " + std::to_string(random() % 100000) +
              "\" name=\"tree\" output=\"screen\" sigterm_timeout=\"0.05\" sigkill_timeout=\"0.05\"/>\n";
    }
    write_file(path, text + "</launch>\n");
    return path.string();
  }

  static void strike(Fault fault, pid_t guardian, pid_t launcher, std::mt19937& random) {
    const microseconds between(random() % 3000);
    switch (fault) {
      case Fault::kLauncher:
        ::kill(launcher, SIGKILL);
        break;
      case Fault::kGuardian:
        ::kill(guardian, SIGKILL);
        break;
      case Fault::kLauncherFirst:
        ::kill(launcher, SIGKILL);
        wait_for(between);
        ::kill(guardian, SIGKILL);
        break;
      case Fault::kGuardianFirst:
        ::kill(guardian, SIGKILL);
        wait_for(between);
        ::kill(launcher, SIGKILL);
        break;
      case Fault::kGroup:
        ::kill(-guardian, SIGKILL);
        break;
      case Fault::kInterrupt:
        ::kill(guardian, SIGINT);
        break;
    }
  }

  Sandbox sandbox_;
};

TEST_P(SupervisionFaults, LeaveNothingBehind) {
  const auto [fault, while_starting] = GetParam();
  for (int round = 0; round < rounds(); ++round) {
    const unsigned seed = static_cast<unsigned>(round * 12 + static_cast<int>(fault) * 2 + (while_starting ? 1 : 0));
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const int trees = while_starting ? 30 : 5;
    RunningCommand run({.argv = {LAUNCH_PROGRAM, write(random, trees)}});
    const std::string number = std::to_string(while_starting ? random() % trees + 1 : static_cast<unsigned>(trees));
    ASSERT_TRUE(run.wait_for_output("[tree-" + number + "]: process started with pid")) << run.out() << run.err();
    const pid_t launcher = launcher_below(run.pid());
    ASSERT_GT(launcher, 0);
    wait_for(microseconds(random() % 2000));
    strike(fault, run.pid(), launcher, random);
    const CommandResult result = run.wait(kPatience);
    ASSERT_FALSE(result.timed_out) << result.out << result.err;
    ASSERT_TRUE(nothing_is_left()) << testing::PrintToString(sandbox_.end_processes()) << result.out << result.err;
  }
}

std::string name_of(const testing::TestParamInfo<std::tuple<Fault, bool>>& test) {
  static const std::map<Fault, std::string> names = {
      {Fault::kLauncher, "LauncherKilled"},
      {Fault::kGuardian, "GuardianKilled"},
      {Fault::kLauncherFirst, "LauncherKilledFirst"},
      {Fault::kGuardianFirst, "GuardianKilledFirst"},
      {Fault::kGroup, "GroupKilled"},
      {Fault::kInterrupt, "CtrlC"},
  };
  return names.at(std::get<0>(test.param)) + (std::get<1>(test.param) ? "WhileStarting" : "");
}

INSTANTIATE_TEST_SUITE_P(All, SupervisionFaults,
                         testing::Combine(testing::Values(Fault::kLauncher, Fault::kGuardian, Fault::kLauncherFirst,
                                                          Fault::kGuardianFirst, Fault::kGroup, Fault::kInterrupt),
                                          testing::Bool()),
                         name_of);

}  // namespace
