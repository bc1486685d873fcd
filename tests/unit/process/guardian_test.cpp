// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/guardian.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "temporary_directory.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

constexpr int kPatience = 30'000;  // milliseconds, before a test fails

bool wait_for(const UniqueFd& fd) {
  pollfd descriptor{fd.get(), POLLIN, 0};
  return ::poll(&descriptor, 1, kPatience) == 1;
}

UniqueFd open_process(pid_t pid) {
  return UniqueFd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

pid_t read_pid(const UniqueFd& fd) {
  std::string line;
  char byte = 0;
  while (wait_for(fd) && ::read(fd.get(), &byte, 1) == 1 && byte != '\n') {
    line.push_back(byte);
  }
  return line.empty() ? -1 : std::stoi(line);
}

ProcessSpec command(std::vector<std::string> argv) {
  ProcessSpec spec;
  spec.name = "test";
  spec.argv = std::move(argv);
  spec.environment = {{"PATH", "/usr/bin:/bin"}};
  return spec;
}

class GuardianTest : public testing::Test {
 protected:
  // Starts a launcher that guards one shell for each script. Stores the pids of guardian and shells in `pids`.
  Process start_launcher(std::chrono::milliseconds grace, const std::vector<std::string>& scripts) {
    std::vector<std::string> argv{DOOMED_LAUNCHER, LAUNCH_GUARDIAN, std::to_string(grace.count())};
    argv.insert(argv.end(), scripts.begin(), scripts.end());
    Process launcher = runner->spawn(command(argv));
    for (std::size_t i = 0; i <= scripts.size(); ++i) {
      pids.push_back(read_pid(launcher.out));
      pidfds.push_back(open_process(pids.back()));
      EXPECT_TRUE(pidfds.back()) << "process " << i;
    }
    return launcher;
  }
  void kill_launcher(const Process& launcher) const {
    ASSERT_EQ(::kill(launcher.pid, SIGKILL), 0);
    ASSERT_TRUE(wait_for(launcher.pidfd));
    EXPECT_EQ(runner->reap(launcher).code, -SIGKILL);
  }
  bool runs(std::size_t i) const {
    pollfd descriptor{pidfds.at(i).get(), POLLIN, 0};
    return ::poll(&descriptor, 1, 0) == 0;
  }

  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
  std::vector<pid_t> pids;
  std::vector<UniqueFd> pidfds;
};

TEST_F(GuardianTest, EndsAllProcessesOfALauncherThatIsKilled) {
  const std::string sleeper = "echo ready; exec sleep 1000";
  const Process launcher = start_launcher(kPatience * 1ms, {sleeper, sleeper, sleeper});
  EXPECT_TRUE(runs(1) && runs(2) && runs(3));
  kill_launcher(launcher);
  for (const UniqueFd& pidfd : pidfds) {
    EXPECT_TRUE(wait_for(pidfd));
  }
}

TEST_F(GuardianTest, KillsWhatDoesNotEndInTheGracePeriod) {
  const Process launcher = start_launcher(20ms, {"trap '' TERM INT; echo ready; while :; do sleep 1000; done"});
  kill_launcher(launcher);
  EXPECT_TRUE(wait_for(pidfds[1]));
  EXPECT_TRUE(wait_for(pidfds[0])) << "the guardian itself ends, too";
}

TEST_F(GuardianTest, EndsDescendants) {
  // The whole group holds it open, so it hangs up when the last member has gone.
  const TemporaryDirectory directory;
  const std::string fifo = directory.path() + "/group";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const UniqueFd group(::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  const Process launcher = start_launcher(
      kPatience * 1ms, {"exec 3> " + fifo + "; (trap '' TERM; exec sleep 1000) & echo ready; exec sleep 1000"});
  pollfd hung_up{group.get(), 0, 0};
  EXPECT_EQ(::poll(&hung_up, 1, 0), 0);
  kill_launcher(launcher);
  EXPECT_EQ(::poll(&hung_up, 1, kPatience), 1);
}

TEST_F(GuardianTest, HasASessionOfItsOwnAndIgnoresInterrupts) {
  const Process launcher = start_launcher(kPatience * 1ms, {"echo ready; exec sleep 1000"});
  EXPECT_EQ(::getsid(pids[0]), pids[0]);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    ::kill(pids[0], signal);
  }
  kill_launcher(launcher);
  EXPECT_TRUE(wait_for(pidfds[1])) << "the guardian was there to end it";
}

TEST_F(GuardianTest, LeavesDetachedGroupsAlone) {
  const Process sleeper = runner->spawn(command({"sleep", "1000"}));
  {
    Guardian guardian(LAUNCH_GUARDIAN);
    guardian.attach(sleeper.pid);
    guardian.detach(sleeper.pid);
  }
  pollfd exited{sleeper.pidfd.get(), POLLIN, 0};
  EXPECT_EQ(::poll(&exited, 1, 0), 0);
  runner->signal_group(sleeper, SIGKILL);
  ASSERT_TRUE(wait_for(sleeper.pidfd));
  runner->reap(sleeper);
}

TEST_F(GuardianTest, EndsWhatIsStillAttachedWhenItIsDestroyed) {
  const Process sleeper = runner->spawn(command({"sleep", "1000"}));
  {
    Guardian guardian(LAUNCH_GUARDIAN);
    guardian.attach(sleeper.pid);
  }
  ASSERT_TRUE(wait_for(sleeper.pidfd));
  EXPECT_EQ(runner->reap(sleeper).code, -SIGTERM);
}

TEST_F(GuardianTest, CleansUpAfterTheGroupsHaveEndedTheLastCommandFirst) {
  const TemporaryDirectory directory;
  const std::string done = directory.path() + "/done";
  const Process sleeper = runner->spawn(command({"sleep", "1000"}));
  {
    Guardian guardian(LAUNCH_GUARDIAN);
    guardian.attach(sleeper.pid);
    guardian.add_clean_up({"/bin/sh", "-c", "echo 'first one' >> " + done});
    // The sleeper is not reaped yet: it is a zombie.
    guardian.add_clean_up(
        {"/bin/sh", "-c",
         "grep -q State:.Z /proc/" + std::to_string(sleeper.pid) + "/status && echo ended >> " + done});
  }
  std::ifstream file(done);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "ended\nfirst one\n");
  ASSERT_TRUE(wait_for(sleeper.pidfd));
  runner->reap(sleeper);
}

TEST_F(GuardianTest, DoesNotRunACleanUpThatWasTakenBack) {
  const TemporaryDirectory directory;
  const std::string done = directory.path() + "/done";
  {
    Guardian guardian(LAUNCH_GUARDIAN);
    guardian.remove_clean_up(guardian.add_clean_up({"/bin/sh", "-c", "echo no >> " + done}));
    guardian.add_clean_up({"/bin/sh", "-c", "echo yes >> " + done});
  }
  std::ifstream file(done);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "yes\n");
}

TEST_F(GuardianTest, GuardsFromTheStartOfAProcessUntilItIsReaped) {
  Guardian guardian(LAUNCH_GUARDIAN);
  GuardedProcessRunner guarded(*runner, guardian);
  const Process process = guarded.spawn(command({"true"}));
  ASSERT_TRUE(wait_for(process.pidfd));
  EXPECT_EQ(guarded.outcome(process).code, 0);
  EXPECT_EQ(guarded.reap(process).code, 0);
}

TEST_F(GuardianTest, TheLaunchGoesOnWhenTheGuardianWasKilled) {
  Guardian guardian(LAUNCH_GUARDIAN);
  const UniqueFd pidfd = open_process(guardian.pid());
  ::kill(guardian.pid(), SIGKILL);
  ASSERT_TRUE(wait_for(pidfd));
  guardian.attach(::getpid());
  guardian.detach(::getpid());
}

TEST_F(GuardianTest, SaysWhichProgramIsMissing) {
  try {
    const Guardian guardian("/nowhere/launch-guardian");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string(error.what()), "cannot start '/nowhere/launch-guardian': No such file or directory");
  }
}

}  // namespace
}  // namespace launch
