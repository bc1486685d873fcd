// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "launcher/process/process_runner.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

constexpr int kPatience = 60'000;  // milliseconds, before a test fails
const std::string kSleeper = "echo ready; exec sleep 1000";
// Leaves a process that has a session of its own, ignores SIGINT, and whose parent has died. The shell would let it
// ignore SIGINT anyway, because it starts it in the background, but it may tell its number before.
const std::string kDaemon =
    "pid=$(setsid sh -c 'trap \"\" INT; sleep 1000 >/dev/null 2>&1 </dev/null & echo $!'); echo $pid; ";

bool wait_for_end(const UniqueFd& fd) {
  pollfd descriptor{fd.get(), POLLIN, 0};
  return ::poll(&descriptor, 1, kPatience) == 1;
}

UniqueFd open_process(pid_t pid) {
  return UniqueFd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

bool runs(const UniqueFd& pidfd) {
  pollfd descriptor{pidfd.get(), POLLIN, 0};
  return ::poll(&descriptor, 1, 0) == 0;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Empty when the process has gone.
std::string name_of(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/comm", process));
  std::string name;
  std::getline(file, name);
  return name;
}

class GuardianTest : public testing::Test {
 protected:
  // What a dead guardian leaves becomes ours.
  GuardianTest() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }
  ~GuardianTest() override { ::prctl(PR_SET_CHILD_SUBREAPER, 0); }

  // Starts a launcher and reads the numbers of guardian, launcher and the shell of each script. With --exit in its
  // words the launcher exits after that.
  void start(std::vector<std::string> words, std::size_t shells) {
    const bool exits = std::ranges::find(words, "--exit") != words.end();
    words.insert(words.begin(), {DOOMED_LAUNCHER, LAUNCH_GUARDIAN});
    ProcessSpec spec;
    spec.name = "test";
    spec.argv = std::move(words);
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    run = runner->spawn(spec);
    guardian = read_pid();
    launcher = read_pid();
    EXPECT_EQ(guardian, run.pid);
    for (std::size_t i = 0; i < shells; ++i) {
      shell_pids.push_back(read_pid());
      shells_.push_back(open_process(shell_pids.back()));
      EXPECT_TRUE(shells_.back()) << "shell " << i;
    }
    if (exits) {
      ::kill(launcher, SIGUSR1);
    }
  }
  std::string read_line() {
    std::string line;
    pollfd readable{run.out.get(), POLLIN, 0};
    for (char byte = 0; ::poll(&readable, 1, kPatience) == 1 && ::read(run.out.get(), &byte, 1) == 1 && byte != '\n';) {
      line.push_back(byte);
    }
    return line;
  }
  // Throws std::invalid_argument if there is none: a signal to process -1 would go to all processes.
  pid_t read_pid() { return std::stoi(read_line()); }
  // How the guardian ended. Everything else has ended then.
  int end() {
    EXPECT_TRUE(wait_for_end(run.pidfd));
    return runner->reap(run).code;
  }
  // Nothing that was started is left, neither as our child.
  static void expect_nothing_left() {
    while (::waitpid(-1, nullptr, 0) > 0) {
    }
    EXPECT_EQ(errno, ECHILD);
  }
  pid_t child_of_guardian(const std::string& name) const {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", guardian));
    for (pid_t child; children >> child;) {
      if (name_of(child) == name) {
        return child;
      }
    }
    return -1;
  }
  pid_t wait_for_spare(pid_t former = -1) const {
    for (pid_t spare = -1;; ::sched_yield()) {
      if ((spare = child_of_guardian("guardian-spare")) > 0 && spare != former) {
        return spare;
      }
    }
  }

  const TemporaryDirectory directory;
  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
  Process run;
  pid_t guardian = -1;
  pid_t launcher = -1;
  std::vector<pid_t> shell_pids;
  std::vector<UniqueFd> shells_;
};

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
  while (true) {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", guardian));
    std::size_t count = 0;
    for (pid_t child; children >> child;) {
      ++count;
    }
    if (count == 2) {
      break;  // the launcher and the spare
    }
    ::sched_yield();
  }
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
}

// A process that has emptied its environment, left its session and lost its parent.
const std::string kHidden =
    "env -i setsid sh -c 'sleep 1000 >/dev/null 2>&1 </dev/null & echo $!' | { read pid; echo $pid; }; ";

// What systemd gives to a scope with Delegate=yes.
class DelegatedCgroup : public GuardianTest {
 protected:
  DelegatedCgroup() {
    std::ifstream mounts("/proc/self/mounts");
    for (std::string device, point, type, rest; mounts >> device >> point >> type && std::getline(mounts, rest);) {
      if (type == "cgroup2") {
        root_ = point;
      }
    }
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
      if (line.starts_with("0::")) {
        before_ = root_ + line.substr(3);
      }
    }
    path_ = fmt::format("{}/guardian-test-{}", root_, ::getpid());
  }
  ~DelegatedCgroup() override {
    enter(before_);
    ::rmdir(path_.c_str());
  }

  // "" or why this machine has no cgroup for a test.
  std::string prepare() const {
    if (root_.empty() || ::mkdir(path_.c_str(), 0755) != 0) {
      return "skipped, because no cgroup of version 2 can be made here";
    }
    if (::setxattr(path_.c_str(), "user.delegate", "1", 1, 0) != 0) {
      return "skipped, because cgroups have no attributes here";
    }
    return enter(path_) ? "" : "skipped, because a cgroup can't be entered here";
  }
  static bool enter(const std::string& cgroup) {
    std::ofstream file(cgroup + "/cgroup.procs");
    file << "0" << std::flush;
    return file.good();
  }
  std::size_t cgroups_below() const {
    return static_cast<std::size_t>(std::count_if(std::filesystem::directory_iterator(path_), {},
                                                  [](const auto& entry) { return entry.is_directory(); }));
  }

  std::string root_;
  std::string before_;
  std::string path_;
};

TEST_F(DelegatedCgroup, HoldsTheLaunchAndIsRemoved) {
  if (const std::string missing = prepare(); !missing.empty()) {
    GTEST_SKIP() << missing;
  }
  start({kSleeper}, 1);
  const std::string of_shell = read_file(fmt::format("/proc/{}/cgroup", shell_pids[0]));
  EXPECT_THAT(of_shell, testing::ContainsRegex("0::/.*guardian-test-[0-9]+/launch-[0-9a-f]{16}\n"));
  EXPECT_EQ(read_file(fmt::format("/proc/{}/cgroup", launcher)), of_shell);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
  EXPECT_EQ(cgroups_below(), 0U);
}

TEST_F(DelegatedCgroup, TellsTheSpareOfAProcessThatHidesFromIt) {
  if (const std::string missing = prepare(); !missing.empty()) {
    GTEST_SKIP() << missing;
  }
  start({"--timeouts", "100", "100", kHidden + "exec sleep 1000"}, 1);
  wait_for_spare();
  ::kill(launcher, SIGKILL);
  ::kill(guardian, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
  EXPECT_EQ(cgroups_below(), 0U);
}

TEST_F(DelegatedCgroup, EndsProcessesThatStartOthersAllTheTime) {
  if (const std::string missing = prepare(); !missing.empty()) {
    GTEST_SKIP() << missing;
  }
  // Each process lives until it has started the next one.
  start({"--timeouts", "100", "100", "trap '' INT TERM; flee() { flee & }; echo ready; flee; exec sleep 1000"}, 1);
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(end(), -SIGKILL);
  expect_nothing_left();
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
