// SPDX-License-Identifier: Apache-2.0
// A process without a session daemon does not load lttng-ust until one starts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lttng/ust-ctl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kFileOfRoot = "/dev/shm/" LTTNG_UST_WAIT_FILENAME;

class DaemonArrival : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) {
      GTEST_SKIP() << "skipped, because without root /dev/shm and /run are not the test's own";
    }
  }

  static std::string output_of(const std::vector<std::string>& argv) {
    const CommandResult result = run_command(argv);
    EXPECT_EQ(result.exit_code, 0) << testing::PrintToString(argv) << result.out << result.err;
    return result.out;
  }
  static void tell(RunningCommand& process, const std::string& line) {
    process.write(line + "\n");
    ASSERT_TRUE(process.wait_for_output(line + "\n")) << process.err();
  }
  // The files that the process has mapped, once it has reached its main().
  static std::string maps_of_started(RunningCommand& process) {
    tell(process, "make 1");
    std::ifstream maps("/proc/" + std::to_string(process.pid()) + "/maps");
    return {std::istreambuf_iterator<char>(maps), {}};
  }
  // `lttng list` tells of the processes that the daemon has registered.
  static bool is_registered(const RunningCommand& process,
                            const std::vector<std::string>& list = {"lttng", "list", "--userspace"}) {
    const std::string pid = std::to_string(process.pid());
    const auto end = std::chrono::steady_clock::now() + test_support::kCommandTimeout;
    while (std::chrono::steady_clock::now() < end) {
      const std::string told = output_of(list);
      if (told.find("PID: " + pid + " ") != std::string::npos ||
          told.find("Process " + pid + ":") != std::string::npos) {  // since LTTng 2.15
        return true;
      }
    }
    return false;
  }
  // Once the process has told its objects to the session, so the next event is recorded.
  std::string recorded_after(RunningCommand& process) {
    const std::string traces = sandbox_.trace_directory() / "run";
    output_of({"lttng", "create", "run", "--output", traces});
    output_of({"lttng", "enable-event", "--userspace", "ros2:*"});
    output_of({"lttng", "start"});
    output_of({"lttng", "list", "--userspace"});
    tell(process, "take 1");
    output_of({"lttng", "destroy"});
    return output_of({"babeltrace2", traces});
  }

  test_support::Sandbox sandbox_;
};

TEST_F(DaemonArrival, IsAwaitedWithoutLttng) {
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  EXPECT_THAT(maps_of_started(process), Not(HasSubstr("/liblttng-ust.so")));
  process.close_input();
  const CommandResult ended = process.wait();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
}

TEST_F(DaemonArrival, MakesTheProcessTraceable) {
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  ASSERT_THAT(maps_of_started(process), Not(HasSubstr("/liblttng-ust.so")));
  output_of({"lttng-sessiond", "--daemonize"});
  ASSERT_TRUE(is_registered(process));
  const std::string events = recorded_after(process);
  EXPECT_THAT(events, HasSubstr("ros2:rcl_timer_init: { cpu_id ="));
  EXPECT_THAT(events, HasSubstr("ros2:rcl_take: { cpu_id ="));
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
}

// LTTng asks for the objects of a process when it registers the process, before it knows the events of the provider.
TEST_F(DaemonArrival, MakesTheProcessTellItsObjectsToASessionThatRunsBeforeItIsRegistered) {
  NEEDS_ITS_OWN_TRACER();
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  ASSERT_THAT(maps_of_started(process), Not(HasSubstr("/liblttng-ust.so")));
  ASSERT_EQ(kill(process.pid(), SIGSTOP), 0);
  output_of({"lttng-sessiond", "--daemonize"});
  const std::string traces = sandbox_.trace_directory() / "run";
  output_of({"lttng", "create", "run", "--output", traces});
  output_of({"lttng", "enable-event", "--userspace", "ros2*"});
  output_of({"lttng", "start"});
  ASSERT_EQ(kill(process.pid(), SIGCONT), 0);
  ASSERT_TRUE(is_registered(process));
  std::string events;
  const auto end = std::chrono::steady_clock::now() + test_support::kCommandTimeout;
  while (events.find("state_dump_end") == std::string::npos && std::chrono::steady_clock::now() < end) {
    output_of({"lttng", "rotate"});
    events = output_of({"babeltrace2", traces});
  }
  EXPECT_THAT(events, HasSubstr("ros2:rcl_timer_init: { cpu_id ="));
  EXPECT_THAT(events, HasSubstr("ros2_ext:state_dump_end: { cpu_id ="));
  process.close_input();
  EXPECT_EQ(process.wait().exit_code, 0);
}

TEST_F(DaemonArrival, IsSeenByEachOfManyProcesses) {
  constexpr int kProcesses = 20;
  std::vector<std::unique_ptr<RunningCommand>> processes;
  for (int i = 0; i < kProcesses; ++i) {
    processes.push_back(std::make_unique<RunningCommand>(test_support::Command{.argv = {OBJECTS_ON_COMMAND}}));
  }
  for (const auto& process : processes) {
    ASSERT_THAT(maps_of_started(*process), Not(HasSubstr("/liblttng-ust.so")));
  }
  output_of({"lttng-sessiond", "--daemonize"});
  for (const auto& process : processes) {
    EXPECT_TRUE(is_registered(*process));
  }
}

// Two daemons may trace the process of a user: root's, and that of the user.
TEST_F(DaemonArrival, OfEitherDaemonIsAwaitedByAnotherUser) {
  const std::vector<std::string> as_user = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  const auto with = [&](std::vector<std::string> argv) {
    argv.insert(argv.begin(), as_user.begin(), as_user.end());
    return argv;
  };
  if (run_command(with({"test", "-x", OBJECTS_ON_COMMAND})).exit_code != 0) {
    GTEST_SKIP() << "skipped, because another user cannot run " OBJECTS_ON_COMMAND;
  }
  const fs::path home = sandbox_.directory() / "user";
  fs::create_directories(home);
  fs::permissions(sandbox_.directory(), fs::perms::others_exec, fs::perm_options::add);
  fs::permissions(home, fs::perms::all);
  for (const bool of_root : {false, true}) {
    RunningCommand process({.argv = with({OBJECTS_ON_COMMAND}), .environment = {{"LTTNG_HOME", home}}});
    ASSERT_THAT(maps_of_started(process), Not(HasSubstr("/liblttng-ust.so"))) << of_root;
    const std::vector<std::string> daemon = {"lttng-sessiond", "--daemonize", "--pidfile=" + (home / "pid").string()};
    const std::vector<std::string> list = {"env", "LTTNG_HOME=" + home.string(), "lttng", "list", "--userspace"};
    output_of(of_root ? daemon : with({"env", "LTTNG_HOME=" + home.string(), daemon[0], daemon[1], daemon[2]}));
    EXPECT_TRUE(is_registered(process, of_root ? list : with(list))) << of_root;
    std::string pid;
    std::ifstream(home / "pid") >> pid;
    ASSERT_EQ(kill(std::stoi(pid), SIGTERM), 0);
    while (kill(std::stoi(pid), 0) == 0 || fs::exists(home / "pid")) {
      waitpid(std::stoi(pid), nullptr, 0);
    }
  }
}

// The first process may be a node or a program that uses lttng-ust itself. Both make the file in one way.
TEST_F(DaemonArrival, IsToldInAFileAsLttngMakesIt) {
  const mode_t before = umask(077);
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  tell(process, "make 1");
  umask(before);
  struct stat status {};
  ASSERT_EQ(stat(kFileOfRoot, &status), 0);
  EXPECT_EQ(status.st_mode, S_IFREG | 0666u);
  EXPECT_EQ(status.st_size, sysconf(_SC_PAGESIZE));
}

TEST_F(DaemonArrival, IsNotAwaitedWhenADaemonRuns) {
  output_of({"lttng-sessiond", "--daemonize"});
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  EXPECT_THAT(maps_of_started(process), HasSubstr("/liblttng-ust.so"));
}

// The file in /dev/shm is one for all daemons of a user, and the first that ends writes 0 into it.
TEST_F(DaemonArrival, IsNotAwaitedWhenThereIsASocketOfADaemon) {
  const fs::path folder = fs::path(std::getenv("LTTNG_HOME")) / ".lttng";
  fs::create_directories(folder);
  std::ofstream(folder / LTTNG_UST_SOCK_FILENAME);
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  EXPECT_THAT(maps_of_started(process), HasSubstr("/liblttng-ust.so"));
}

// As a daemon that was killed leaves it.
TEST_F(DaemonArrival, IsNotAwaitedWhenTheFileSaysThatADaemonRuns) {
  constexpr std::int32_t kRuns = 1;
  std::ofstream(kFileOfRoot, std::ios::binary).write(reinterpret_cast<const char*>(&kRuns), sizeof kRuns);
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}});
  EXPECT_THAT(maps_of_started(process), HasSubstr("/liblttng-ust.so"));
}

TEST_F(DaemonArrival, IsLeftToLttngInAProgramThatUsesIt) {
  NEEDS_WHAT_QEMU_LACKS("a process has a thread more here, as under QEMU");
  if (test_support::kThreadSanitized) {
    GTEST_SKIP() << test_support::kHasOneMoreThread;
  }
  RunningCommand process({.argv = {OBJECTS_ON_COMMAND}, .environment = {{"LD_PRELOAD", "liblttng-ust.so.1"}}});
  tell(process, "make 1");
  EXPECT_EQ(std::distance(fs::directory_iterator("/proc/" + std::to_string(process.pid()) + "/task"), {}), 3)
      << "the main thread, and two of lttng-ust";
}

}  // namespace
