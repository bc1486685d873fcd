// SPDX-License-Identifier: Apache-2.0
// launch-guardian where it may make cgroups: no process gets away.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "guardian_fixture.hpp"

namespace launch {
namespace {

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

}  // namespace
}  // namespace launch
