// SPDX-License-Identifier: Apache-2.0
// Limits that the kernel holds: by cgroups of version 2, and for the threads of real time.
//
// Needs the controllers in version 2: `./dev test-kernel` runs it in a guest.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience(120);
const fs::path kRoot = "/sys/fs/cgroup";

class Limits : public testing::Test {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) {
      GTEST_SKIP() << "skipped, because only root may make cgroups where none is delegated";
    }
    if (!fs::exists(kRoot / "cgroup.controllers")) {
      ::mount("cgroup2", kRoot.c_str(), "cgroup2", 0, nullptr);
    }
    std::ifstream file(kRoot / "cgroup.controllers");
    const std::string controllers{std::istreambuf_iterator<char>(file), {}};
    for (const char* const needed : {"memory", "cpu", "pids"}) {
      if (controllers.find(needed) == std::string::npos) {
        GTEST_SKIP() << "skipped, because the controller " << needed << " is not in version 2 of cgroups here";
      }
    }
  }
  std::string write(const std::string& actions) {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }
  CommandResult launch(const std::string& actions) {
    return run_command({.argv = {LAUNCH_PROGRAM, write(actions)}}, kPatience);
  }
  // A process that runs this Python script.
  std::string script(const std::string& text, const std::string& attributes) {
    const fs::path path = sandbox_.directory() / "script.py";
    write_file(path, text);
    return "<executable name=\"script\" output=\"screen\" cmd=\"/usr/bin/python3 -u " + path.string() + "\" " +
           attributes + "/>";
  }
  std::string go_on() const { return sandbox_.directory() / "go_on"; }
  static std::vector<std::string> trees() {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) {
      if (entry.path().filename().string().starts_with("launch-")) {
        found.push_back(entry.path().string());
      }
    }
    return found;
  }

  Sandbox sandbox_;
};

constexpr const char* kHungry = R"py(
import time
kept = []
while True:
    kept.append(bytearray(b'x' * (1 << 20)))
    time.sleep(0.02)
)py";

TEST_F(Limits, OfMemoryEndAProcessAndTheLaunchSaysSo) {
  // It stays near its limit until it is told to go on.
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(script(R"py(
import os, time
path = '/sys/fs/cgroup' + open('/proc/self/cgroup').read().strip().split('0::')[-1] + '/memory.current'
kept = []
while int(open(path).read()) < 60 << 20:
    kept.append(bytearray(b'x' * (1 << 19)))
while not os.path.exists(')py" + go_on() + R"py('):
    time.sleep(0.05)
kept.append(b'x' * (512 << 20))
)py",
                                                               R"(memory_max="64M")"))}});
  EXPECT_TRUE(launch.wait_for_output("[script-1]: it uses ", kPatience)) << launch.out();
  write_file(go_on(), "");
  const CommandResult result = launch.wait(kPatience);
  const std::string all = result.out + result.err;
  EXPECT_THAT(all, ContainsRegex("it uses [0-9.]+ MiB of its memory_max of 64.0 MiB"));
  EXPECT_THAT(all, HasSubstr("the kernel has ended it, because it had used up its memory_max of 64.0 MiB ("));
  EXPECT_THAT(all, HasSubstr("script-1: SIGKILL by the kernel, for want of memory, after"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(trees(), testing::IsEmpty());
}

TEST_F(Limits, OfAGroupAreThoseOfItsProcessesTogether) {
  const CommandResult result = launch("<group memory_max=\"96M\">" + script("kept = b'x' * (512 << 20)\n", "") +
                                      R"(<executable cmd="sleep 1000"/></group>
                                         <on_process_exit process="script"><shutdown/></on_process_exit>)");
  EXPECT_THAT(result.out + result.err, HasSubstr("the kernel has ended it for want of memory ("));
  EXPECT_THAT(trees(), testing::IsEmpty());
}

TEST_F(Limits, OfMemoryHighSlowAProcessAndTheLaunchSaysSo) {
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, write(script(kHungry, R"(memory_high="32M" memory_max="512M")"))}});
  EXPECT_TRUE(launch.wait_for_output("it has exceeded its memory_high of 32.0 MiB: the kernel slows it", kPatience))
      << launch.out();
  launch.send_signal(SIGINT);
  launch.wait(kPatience);
}

TEST_F(Limits, OfProcessesRefuseOneMore) {
  const CommandResult result = launch(script(R"py(
import os, time
try:
    for i in range(100):
        if os.fork() == 0:
            time.sleep(1000)
except OSError as error:
    print('refused', i)
    time.sleep(5)
os._exit(0)
)py",
                                             R"(pids_max="8")"));
  EXPECT_THAT(result.out, HasSubstr("refused 7\n"));
  EXPECT_THAT(result.out + result.err, HasSubstr("it has reached its pids_max of 8"));
  EXPECT_THAT(trees(), testing::IsEmpty()) << "also the processes that it has left have ended";
}

TEST_F(Limits, OfProcessorsHoldWhateverAProcessStarts) {
  const CommandResult result = launch(script(R"py(
import os, time
path = '/sys/fs/cgroup' + open('/proc/self/cgroup').read().strip().split('0::')[-1] + '/cpu.stat'
def used():
    return sum(int(line.split()[1]) for line in open(path) if line.startswith('usage_usec')) / 1e6
if os.fork() == 0:
    while True:
        pass
before = used()
begin = time.monotonic()
while time.monotonic() < begin + 4:
    pass
print('share %.2f' % ((used() - before) / (time.monotonic() - begin)))
)py",
                                             R"(cpu_quota="50%")"));
  EXPECT_THAT(result.out, ContainsRegex("share 0\\.[345]")) << result.out << result.err;
}

TEST_F(Limits, AreInPsAndNothingIsLeftAfterKill9) {
  RunningCommand launch(
      {.argv = {
           LAUNCH_PROGRAM,
           write("<group pids_max=\"50\">" +
                 script(
                     "import time\nprint('up')\nkept = bytearray(b'x' * (40 << 20))\nprint('full')\ntime.sleep(1000)\n",
                     R"(memory_max="100M")") +
                 "</group>")}});
  ASSERT_TRUE(launch.wait_for_output("full", kPatience));
  EXPECT_THAT(run_command({LAUNCH_PROGRAM, "ps"}).out, ContainsRegex("MiB \\([4-9][0-9] %\\)"));
  const std::string json = run_command({LAUNCH_PROGRAM, "ps", "--json"}).out;
  EXPECT_THAT(json, AllOf(HasSubstr(R"("memory_max": 104857600)"), HasSubstr(R"("pids_max": 50)"),
                          HasSubstr(R"("name": "group.1")"), HasSubstr(R"("memory_share": 0.)")));
  ASSERT_EQ(trees().size(), 1U);
  // The launcher is below the two guardians.
  run_command({"sh", "-c", "kill -9 $(pgrep -P $(pgrep -P " + std::to_string(launch.pid()) + "))"});
  launch.wait(kPatience);
  Sandbox::wait_until_daemons_are_left();
  EXPECT_THAT(trees(), testing::IsEmpty());
}

// A cgroup such as systemd gives to a unit with Delegate=yes.
class DelegatedLimits : public Limits {
 protected:
  void SetUp() override {
    Limits::SetUp();
    if (!IsSkipped()) {
      fs::create_directory(scope_);
      ASSERT_EQ(::setxattr(scope_.c_str(), "trusted.delegate", "1", 1, 0), 0);
    }
  }
  ~DelegatedLimits() override { ::rmdir(scope_.c_str()); }
  // As `systemd-run --scope` does: the shell is in the cgroup, and there it becomes the launch.
  Command inside(const std::string& file) const {
    return {
        .argv = {"sh", "-c", "echo $$ >" + (scope_ / "cgroup.procs").string() + "; exec " LAUNCH_PROGRAM " " + file}};
  }
  std::vector<std::string> below() const {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(scope_)) {
      if (entry.is_directory()) {
        found.push_back(entry.path().filename().string());
      }
    }
    return found;
  }

  fs::path scope_ = kRoot / ("delegated-" + std::to_string(::getpid()) + ".scope");
};

TEST_F(DelegatedLimits, AreMadeThereAndNothingIsLeft) {
  const CommandResult result =
      run_command(inside(write(script("kept = b'x' * (512 << 20)\n", R"(memory_max="64M")"))), kPatience);
  EXPECT_THAT(result.out + result.err,
              HasSubstr("the kernel has ended it, because it had used up its memory_max of 64.0 MiB ("));
  EXPECT_THAT(result.out + result.err, Not(HasSubstr("no effect")));
  EXPECT_THAT(below(), testing::IsEmpty());
  EXPECT_THAT(trees(), testing::IsEmpty());
}

TEST_F(DelegatedLimits, AreGoneAfterKill9OfTheLauncher) {
  RunningCommand launch(inside(
      write(script("import time\nprint('full')\ntime.sleep(1000)\n", R"(memory_max="100M" sigterm_timeout="0.2")"))));
  ASSERT_TRUE(launch.wait_for_output("full", kPatience));
  EXPECT_EQ(below().size(), 3U) << "the launcher, the limited process, and what is outside";
  run_command({"sh", "-c", "kill -9 $(pgrep -P $(pgrep -P " + std::to_string(launch.pid()) + "))"});
  launch.wait(kPatience);
  Sandbox::wait_until_daemons_are_left();
  EXPECT_THAT(below(), testing::IsEmpty());
}

TEST_F(Limits, ADeadlineIsThatOfTheMainThreadAndOthersMayBeStarted) {
  const CommandResult result = launch(script(R"py(
import os, threading
def policy(thread):
    return [line.split(':')[1].strip() for line in open('/proc/self/task/%s/sched' % thread) if line.startswith('policy')]
print('main', policy(os.getpid()))
other = []
thread = threading.Thread(target=lambda: other.append(policy(threading.get_native_id())))
thread.start()
thread.join()
print('other', other)
)py",
                                             R"(sched_policy="deadline" sched_runtime="0.01" sched_deadline="0.1")"));
  EXPECT_THAT(result.out, AllOf(HasSubstr("main ['6']"), HasSubstr("other [['0']]"))) << result.err;
}

}  // namespace
