// SPDX-License-Identifier: Apache-2.0
// Which launches `launch ps` and other commands find, and what they say of one that does not answer.
#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/command_line/control_fixture.hpp"

namespace test_support {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class FoundLaunches : public Control {};

// More clients than may wait for a launcher are refused by the system at once.
TEST_F(FoundLaunches, ALaunchThatDoesNotAnswerIsNamedHoweverManyWaitForIt) {
  RunningCommand run(launch({write(kTalker)}));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  const pid_t launcher = launcher_below(run.pid());
  ASSERT_EQ(::kill(launcher, SIGSTOP), 0);
  std::vector<int> waiting;
  const fs::path before = fs::current_path();
  fs::current_path(runtime_ / "launch");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  sockets().front().copy(address.sun_path, sizeof address.sun_path - 1);
  do {
    waiting.push_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
  } while (::connect(waiting.back(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  EXPECT_EQ(errno, EAGAIN);
  fs::current_path(before);
  EXPECT_THAT(ask({"ps"}).err,
              testing::StartsWith("launch ps: error: launch " + std::to_string(run.pid()) + " does not answer\n"));
  for (const int fd : waiting) {
    ::close(fd);
  }
  ::kill(launcher, SIGCONT);
  EXPECT_THAT(ask({"ps"}).out, HasSubstr("talker-1"));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(FoundLaunches, RootSeesTheLaunchesOfOthersAndWhoseTheyAre) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "skipped, because it needs root";
  }
  // In a /run of its own: tests beside must not see the launch of another user.
  ASSERT_EQ(::unshare(CLONE_NEWNS), 0);
  ASSERT_EQ(::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr), 0);
  ASSERT_EQ(::mount("tmpfs", "/run", "tmpfs", 0, nullptr), 0);
  constexpr uid_t kOther = 54321;  // nobody has it
  const fs::path directory = "/run/user/54321";
  const fs::path logs = sandbox_.directory() / "logs";
  for (const fs::path& own : {directory, logs}) {
    fs::create_directories(own);
    fs::permissions(own, fs::perms::owner_all);
    ASSERT_EQ(::chown(own.c_str(), kOther, kOther), 0);
  }
  fs::permissions(sandbox_.directory(), fs::perms::others_exec | fs::perms::others_read, fs::perm_options::add);
  Command other = launch({write(kTalker)});
  other.argv.insert(other.argv.begin(), {"setpriv", "--reuid=54321", "--regid=54321", "--clear-groups"});
  other.environment = {
      {"XDG_RUNTIME_DIR", directory.string()}, {"ROS_LOG_DIR", logs.string()}, {"HOME", logs.string()}};
  {
    RunningCommand run(other);
    EXPECT_TRUE(run.wait_for_output("[talker-1] ready", kPatience)) << run.out() << run.err();
    const std::string number = std::to_string(run.pid());
    EXPECT_THAT(ask({"ps"}).out, HasSubstr("launch " + number + " of 54321: system.launch.xml, running"));
    EXPECT_THAT(ask({"stop", "talker"}).err,
                HasSubstr("no launch of this user runs; choose one with --launch NUMBER:\n  " + number + " "));
    EXPECT_EQ(ask({"shutdown", "--launch", number}).exit_code, 0);
    EXPECT_EQ(run.wait().exit_code, 0);
  }
}

}  // namespace
}  // namespace test_support
