// SPDX-License-Identifier: Apache-2.0
// Limits and scheduling of real processes, applied by launch-exec.
#include "launcher/process/resource_limits.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {
namespace {

class Limits : public testing::Test {
 protected:
  static ProcessSpec script(const std::string& text) {
    ProcessSpec spec;
    spec.name = "a";
    spec.argv = {"sh", "-c", text};
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    return spec;
  }

  std::string output_of(const ProcessSpec& spec) {
    const Process process = runner_->spawn(spec);
    std::string text;
    for (;;) {
      pollfd readable{process.out.get(), POLLIN, 0};
      ::poll(&readable, 1, -1);
      char buffer[256];
      const ssize_t size = ::read(process.out.get(), buffer, sizeof buffer);
      if (size <= 0) {
        break;
      }
      text.append(buffer, static_cast<std::size_t>(size));
    }
    pollfd exited{process.pidfd.get(), POLLIN, 0};
    ::poll(&exited, 1, -1);
    EXPECT_EQ(runner_->reap(process).code, 0);
    return text;
  }

  std::string error_of(const ProcessSpec& spec) {
    try {
      runner_->spawn(spec);
    } catch (const std::system_error& error) {
      return error.what();
    }
    return {};
  }

  std::unique_ptr<ProcessRunner> runner_ = make_posix_process_runner(LAUNCH_EXEC);
};

TEST_F(Limits, HoldFromTheFirstInstructionOn) {
  ProcessSpec spec = script(
      "nice; ulimit -n; ulimit -d; grep Cpus_allowed_list /proc/self/status; "
      "cut -d' ' -f41 /proc/self/stat");
  spec.limits.niceness = 7;
  spec.limits.open_files = 33;
  spec.limits.memory = 64 << 20;
  spec.limits.cpus = {0};
  spec.limits.policy = SCHED_BATCH;
  EXPECT_EQ(output_of(spec), "7\n33\n65536\nCpus_allowed_list:\t0\n" + std::to_string(SCHED_BATCH) + "\n");
}

TEST_F(Limits, LeaveArgumentsEnvironmentAndDescriptorsAsTheyAre) {
  ProcessSpec spec = script("echo \"$0 $1 $B\"; ls /proc/self/fd | wc -l");
  spec.argv.insert(spec.argv.end(), {"- c0", "two words"});
  spec.environment["B"] = "b";
  const std::string without = output_of(spec);
  spec.limits.niceness = 1;
  EXPECT_EQ(output_of(spec), without);
  EXPECT_THAT(without, testing::StartsWith("- c0 two words b\n"));
}

TEST_F(Limits, ThatAreRefusedAreErrorsOfTheStart) {
  ProcessSpec spec = script("true");
  spec.limits.cpus = {1000};
  EXPECT_THAT(error_of(spec), testing::MatchesRegex("cannot run on the CPUs 1000 \\(the launcher may use [-,0-9]+\\): "
                                                    "Invalid argument"));
  spec.limits.cpus.clear();
  spec.limits.open_files = 2'000'000'000;  // more than the kernel allows to anybody
  rlimit hard{};
  ::getrlimit(RLIMIT_NOFILE, &hard);
  EXPECT_EQ(error_of(spec), "cannot allow 2000000000 open files (the hard limit is " + std::to_string(hard.rlim_max) +
                                "; raise it with the line `YOUR_USER - nofile 2000000000` in a file in "
                                "/etc/security/limits.d): Operation not permitted");
}

TEST_F(Limits, DoNotHideAProgramThatCannotBeRun) {
  ProcessSpec spec = script("true");
  spec.argv = {"/nowhere/program"};
  spec.limits.niceness = 1;
  EXPECT_EQ(error_of(spec), "cannot find the program '/nowhere/program': No such file or directory");
}

TEST_F(Limits, NeedLaunchExec) {
  runner_ = make_posix_process_runner("/nowhere/launch-exec");
  ProcessSpec spec = script("true");
  spec.limits.niceness = 1;
  EXPECT_EQ(error_of(spec), "cannot find the program '/nowhere/launch-exec': No such file or directory");
}

TEST(LimitFailure, SaysHowToPermit) {
  const std::string user = ::getuid() == 0 ? "root" : "YOUR_USER";
  const ResourceLimits limits{.niceness = -5, .policy = SCHED_FIFO, .priority = 80};
  EXPECT_EQ(limit_failure(kStepNice, EACCES, limits),
            "cannot set the niceness -5 (add the line `" + user +
                " - nice -5` to a file in /etc/security/limits.d and log in again, or give the launcher the capability "
                "CAP_SYS_NICE)");
  EXPECT_EQ(
      limit_failure(kStepPolicy, EPERM, limits),
      "cannot set the scheduling policy fifo with priority 80 (add the line `" + user +
          " - rtprio 80` to a file in /etc/security/limits.d and log in again, or give the launcher the capability "
          "CAP_SYS_NICE)");
}

}  // namespace
}  // namespace launch
