// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of launch-guardian: a launcher with processes, which a test kills.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/process_runner.hpp"
#include "temporary_directory.hpp"

namespace launch {

constexpr int kGuardianPatience = 60'000;  // milliseconds, before a test fails
inline const std::string kSleeper = "echo ready; exec sleep 1000";

inline bool wait_for_end(const UniqueFd& fd) {
  pollfd descriptor{fd.get(), POLLIN, 0};
  return ::poll(&descriptor, 1, kGuardianPatience) == 1;
}

inline UniqueFd open_process(pid_t pid) {
  return UniqueFd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

inline bool runs(const UniqueFd& pidfd) {
  pollfd descriptor{pidfd.get(), POLLIN, 0};
  return ::poll(&descriptor, 1, 0) == 0;
}

inline std::string read_file(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Empty when the process has gone.
inline std::string name_of_process(pid_t process) {
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
    words.insert(words.begin(), before.begin(), before.end());
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
    for (char byte = 0;
         ::poll(&readable, 1, kGuardianPatience) == 1 && ::read(run.out.get(), &byte, 1) == 1 && byte != '\n';) {
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
  static std::vector<pid_t> children(pid_t parent) {
    std::ifstream file(fmt::format("/proc/{0}/task/{0}/children", parent));
    std::vector<pid_t> all;
    for (pid_t child; file >> child;) {
      all.push_back(child);
    }
    return all;
  }
  pid_t child_of_guardian(const std::string& name) const {
    for (const pid_t child : children(guardian)) {
      if (name_of_process(child) == name) {
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
  std::vector<std::string> before;  // the words of a program that starts the launcher
  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
  Process run;
  pid_t guardian = -1;
  pid_t launcher = -1;
  std::vector<pid_t> shell_pids;
  std::vector<UniqueFd> shells_;
};

}  // namespace launch
