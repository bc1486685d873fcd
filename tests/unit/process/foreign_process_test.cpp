// SPDX-License-Identifier: Apache-2.0
// launch-guardian and a process of another user, as `sudo` makes it: it has its time, and the launch says what is left.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "guardian_fixture.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

class ForeignProcess : public GuardianTest {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) {
      GTEST_SKIP() << "skipped, because only root can make a process of another user";
    }
    fs::permissions(directory.path(), fs::perms::all);
    fs::copy_file(HOSTILE_PROCESS, program);
    ASSERT_EQ(::chmod(program.c_str(), S_ISUID | S_IRWXU | S_IRGRP | S_IXGRP | S_IROTH | S_IXOTH), 0);
    std::ofstream(log) << "";
    fs::permissions(log, fs::perms::all);
    before = {"/usr/bin/setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  }
  const std::string program = directory.path() + "/program";
  const std::string log = directory.path() + "/launch.log";
};

TEST_F(ForeignProcess, IsNamedAfterItsTimeouts) {
  const auto begin = std::chrono::steady_clock::now();
  start({"--timeouts", "300", "300", "--log", log, "--exit", "0", "exec " + program + " root"}, 1);
  EXPECT_EQ(end(), 1) << "a process could not be ended";
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(600)) << "both timeouts";
  EXPECT_TRUE(runs(shells_[0]));
  EXPECT_THAT(read_file(log), HasSubstr(fmt::format("[ERROR] [launch]: cannot end program ({}): another user owns what "
                                                    "is left\n",
                                                    shell_pids[0])));
  ::kill(shell_pids[0], SIGKILL);
  expect_nothing_left();
}

TEST_F(ForeignProcess, HasItsTimeToEndByItself) {
  start({"--timeouts", "1000000", "1000000", "--log", log, "--exit", "0", "exec " + program + " root"}, 1);
  while (read_file(log).find("ending it") == std::string::npos) {
    ::sched_yield();
  }
  ::kill(shell_pids[0], SIGTERM);  // this test is root
  EXPECT_EQ(end(), 0);
  EXPECT_THAT(read_file(log), Not(HasSubstr("cannot end")));
  expect_nothing_left();
}

}  // namespace
}  // namespace launch
