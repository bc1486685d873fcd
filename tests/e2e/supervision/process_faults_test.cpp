// SPDX-License-Identifier: Apache-2.0
// What the machine and programs can do to a launch: limits that are reached, many ends at once, a log that can't be
// written, a clock that jumps. The launch tells of it, goes on, and leaves nothing behind.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

using namespace test_support;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{120};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) {
    ++found;
  }
  return found;
}

// Holds a lock on a file, so that programs wait for it.
class HeldLock {
 public:
  explicit HeldLock(const std::string& file) : fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    ::flock(fd_, LOCK_EX);
  }
  ~HeldLock() { release(); }
  HeldLock(const HeldLock&) = delete;
  HeldLock& operator=(const HeldLock&) = delete;

  void release() {
    if (fd_ >= 0) {
      ::close(fd_);
      fd_ = -1;
    }
  }

 private:
  int fd_;
};

class ProcessFaults : public testing::Test {
 protected:
  std::string write(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }
  // So many programs that do the same.
  static std::string many(int number, const std::string& attributes) {
    std::string all;
    for (int i = 0; i < number; ++i) {
      all += "<executable name=\"n\" " + attributes + "/>\n";
    }
    return all;
  }
  std::string make_fifo() const {
    const std::string path = sandbox_.directory() / "fifo";
    ::mkfifo(path.c_str(), 0600);
    return path;
  }
  std::string log(const RunningCommand& run) const {
    const std::string key = "All log files can be found below ";
    const std::size_t begin = run.out().find(key) + key.size();
    return run.out().substr(begin, run.out().find('\n', begin) - begin);
  }

  Sandbox sandbox_;
};

TEST_F(ProcessFaults, DescriptorsThatRunOutFailStartsAndNotTheLaunch) {
  // Each process takes four descriptors of the launcher.
  const std::string file = write(many(1000, "cmd=\"sleep 1000\""));
  RunningCommand run({.argv = {"prlimit", "--nofile=300:300", LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[n-1000]: exception occurred while executing process: ", kPatience));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_TRUE(result.output_closed);
  const std::size_t started = count(result.out, "process started with pid");
  EXPECT_GT(started, 50U);
  EXPECT_EQ(started + count(result.out, "]: exception occurred while executing process: "), 1000U);
  EXPECT_THAT(result.out, HasSubstr(": Too many open files (" + file + ":1001:2)\n"));
}

TEST_F(ProcessFaults, ProcessesThatRunOutFailStartsAndNotTheLaunch) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "skipped, because it needs a user of its own, whose processes are counted";
  }
  if (test_support::kThreadSanitized) {
    GTEST_SKIP() << test_support::kHasOneMoreThread;
  }
  const std::string file = write(many(40, "cmd=\"sleep 1000\""));
  ASSERT_EQ(::chmod(sandbox_.directory().c_str(), 0777), 0);
  for (const auto& entry : fs::recursive_directory_iterator(sandbox_.directory())) {
    fs::permissions(entry.path(), fs::perms::all);
  }
  // No other process of the machine has this user. The launcher and its two guardians are among the 20.
  RunningCommand run(
      {.argv = {"prlimit", "--nproc=20:20", "setpriv", "--reuid=47110", "--clear-groups", LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[n-40]: exception occurred while executing process: ", kPatience))
      << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_TRUE(result.output_closed);
  EXPECT_EQ(count(result.out, "process started with pid"), 17U) << result.out;
  EXPECT_THAT(result.out, HasSubstr(": Resource temporarily unavailable (" + file + ":41:2)\n"));
}

TEST_F(ProcessFaults, AThousandProcessesThatEndAtOnceAreAllReported) {
  const std::string lock = sandbox_.directory() / "lock";
  HeldLock held(lock);
  const std::string file = write(many(1000, "cmd=\"flock --shared " + lock + " true\""));
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[n-1000]: process started with pid", kPatience)) << run.err();
  held.release();
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count(result.out, "process has finished cleanly"), 1000U);
}

TEST_F(ProcessFaults, ProcessesThatLeaveZombiesEnd) {
  const std::string file = write(
      "<executable name=\"careless\" output=\"screen\" cmd=\"python3 -c &quot;import os, signal&#10;"
      "for i in range(50):&#10; os.fork() or os._exit(0)&#10;print('ready', flush=True)&#10;signal.pause()&quot;\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[careless-1] ready", kPatience)) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_TRUE(result.output_closed);
  EXPECT_THAT(result.out, Not(HasSubstr(" left "))) << "zombies are no processes that run";
}

TEST_F(ProcessFaults, AProcessThatClosesItsOutputIsSupervisedOn) {
  const std::string fifo = make_fifo();
  const std::string file =
      write("<executable name=\"silent\" shell=\"true\" cmd=\"exec 1&gt;&amp;- 2&gt;&amp;-; read x &lt; " + fifo +
            "; exit 7\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[silent-1]: process started with pid")) << run.err();
  run_command({.argv = {"sh", "-c", "echo > " + fifo}}, kPatience);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("[ERROR] [launch]:   silent-1: exit code 7 after "));
}

TEST_F(ProcessFaults, ALaunchWithoutStandardDescriptorsRuns) {
  const std::string done = sandbox_.directory() / "done";
  const std::string file =
      write("<executable shell=\"true\" output=\"screen\" cmd=\"echo here; echo ended &gt; " + done + "\"/>");
  const CommandResult result =
      run_command({"sh", "-c", std::string("exec ") + LAUNCH_PROGRAM + " " + file + " <&- >&- 2>&-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(read_file(done), "ended\n");
}

TEST_F(ProcessFaults, ALogDirectoryThatIsDeletedStopsNothing) {
  const std::string fifo = make_fifo();
  const std::string file = write(
      "<executable name=\"a\" shell=\"true\" output=\"full\" respawn=\"true\" respawn_max_retries=\"1\""
      " cmd=\"echo here; read x &lt; " +
      fifo + "\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[a-1] here")) << run.out() << run.err();
  // The launcher may make a file there meanwhile.
  for (std::error_code error; fs::exists(log(run));) {
    fs::remove_all(log(run), error);
  }
  run_command({.argv = {"sh", "-c", "echo > " + fifo}}, kPatience);
  // Otherwise the first process could hold the pipe still, and get what is for the second one.
  ASSERT_TRUE(run.wait_for_output("[a-1]: process has finished cleanly")) << run.out() << run.err();
  run_command({.argv = {"sh", "-c", "echo > " + fifo}}, kPatience);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(count(result.out, "[a-1] here\n"), 2U) << result.out;
}

TEST_F(ProcessFaults, AFullDiskForLogsStopsNothing) {
  const fs::path disk = sandbox_.directory() / "disk";
  fs::create_directory(disk);
  if (::geteuid() != 0 || ::mount("none", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "skipped, because no small disk can be mounted";
  }
  const std::string file = write(
      "<executable name=\"a\" shell=\"true\" output=\"full\" cmd=\"seq 1 100000\"/>\n"
      "<executable name=\"b\" shell=\"true\" output=\"log\" cmd=\"echo here\"/>");
  const CommandResult result =
      run_command({.argv = {LAUNCH_PROGRAM, file}, .environment = {{"ROS_LOG_DIR", disk.string()}}}, kPatience);
  EXPECT_EQ(::umount(disk.c_str()), 0) << "nothing holds it any more";
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("[a-1] 100000\n"));
  EXPECT_THAT(result.out + result.err, HasSubstr("No space left on device"));
  EXPECT_TRUE(result.output_closed);
}

class JumpingClock : public ProcessFaults, public testing::WithParamInterface<const char*> {};

TEST_P(JumpingClock, ChangesNoTimeout) {
  const std::string turns = sandbox_.directory() / "turns";
  // Each look at the time of day jumps forwards or backwards.
  const std::string file = write(
      "<executable name=\"stubborn\" shell=\"true\" output=\"screen\" sigterm_timeout=\"0.2\""
      " sigkill_timeout=\"0.2\" cmd=\"unset LD_PRELOAD; trap : INT TERM; echo ready; while :; do read x; done\"/>\n"
      "<executable name=\"again\" shell=\"true\" output=\"screen\" respawn=\"true\" respawn_delay=\"0.05\""
      " respawn_max_retries=\"3\" cmd=\"echo &gt;&gt; " +
      turns + "; wc -l &lt; " + turns + "\"/>");
  RunningCommand run(
      {.argv = {LAUNCH_PROGRAM, file}, .environment = {{"LD_PRELOAD", JUMPING_CLOCK}, {"JUMP_SECONDS", GetParam()}}});
  ASSERT_TRUE(run.wait_for_output("[again-2] 4\n", kPatience)) << run.out() << run.err();
  ASSERT_TRUE(run.wait_for_output("[stubborn-1] ready", kPatience)) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("failed to terminate '0.2' seconds after receiving 'SIGINT', escalating to 'SIGTERM'"));
}
INSTANTIATE_TEST_SUITE_P(ByAnHourAndByThirtyYears, JumpingClock, testing::Values("3600", "946080000"));

TEST_F(ProcessFaults, TwoLaunchesOfOneFileDoNotTouchEachOther) {
  const std::string file = write(
      "<executable name=\"a\" shell=\"true\" output=\"screen\" sigterm_timeout=\"0.1\" sigkill_timeout=\"0.1\""
      " cmd=\"say() { echo alive; }; trap say USR1; echo ready; setsid sleep 1000 &amp; while :; do read x; done\"/>");
  RunningCommand first({.argv = {LAUNCH_PROGRAM, file}});
  RunningCommand second({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(first.wait_for_output("[a-1] ready")) << first.out() << first.err();
  ASSERT_TRUE(second.wait_for_output("[a-1] ready")) << second.out() << second.err();
  ::kill(-first.pid(), SIGKILL);  // launcher and guardian; the spare ends the rest
  EXPECT_EQ(first.wait(kPatience).signal, SIGKILL);
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "signal", "--launch", std::to_string(second.pid()), "a", "USR1"}).exit_code,
            0);
  ASSERT_TRUE(second.wait_for_output("[a-1] alive")) << second.out() << second.err();
  second.send_signal(SIGINT);
  EXPECT_EQ(second.wait(kPatience).exit_code, 0);
  Sandbox::wait_until_daemons_are_left();
}

// The session daemon of this test alone.
pid_t session_daemon() {
  return std::stoi(read_file("/run/lttng/lttng-sessiond.pid"));
}

TEST_F(ProcessFaults, AKilledSessionDaemonEndsNoProcessAndBlocksNoEnd) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the session daemon belongs to other tests, too";
  }
  const std::string file = write(
      "<trace session-name=\"run\"/>\n<executable name=\"node\" shell=\"true\" output=\"screen\""
      " cmd=\"say() { echo alive; }; trap say USR1; echo ready; while :; do read x; done\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("[node-1] ready", kPatience)) << run.out() << run.err();
  ::kill(session_daemon(), SIGKILL);
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "signal", "node", "USR1"}).exit_code, 0);
  ASSERT_TRUE(run.wait_for_output("[node-1] alive", kPatience)) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  EXPECT_THAT(result.err, HasSubstr("tracing session 'run' could not be finished: "));
  Sandbox::wait_until_daemons_are_left();
}

// Takes what is sent to it and says nothing.
const char* const kSilentDaemon = R"py(
import ctypes, os, socket
ctypes.CDLL(None).prctl(15, b"lttng-sessiond", 0, 0, 0)
os.makedirs("/run/lttng", exist_ok=True)
daemon = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
daemon.bind("/run/lttng/client-lttng-sessiond")
daemon.listen()
with open("/run/lttng/lttng-sessiond.pid", "w") as file:
    file.write(str(os.getpid()))
print("ready", flush=True)
clients = []
while True:
    clients.append(daemon.accept()[0])
    clients[-1].recv(1)
    print("asked", flush=True)
)py";

TEST_F(ProcessFaults, ASessionDaemonThatDoesNotAnswerBlocksNoEnd) {
  if (::geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the session daemon belongs to other tests, too";
  }
  RunningCommand daemon({.argv = {"python3", "-c", kSilentDaemon}});
  ASSERT_TRUE(daemon.wait_for_output("ready", kPatience)) << daemon.err();
  const std::string file = write("<trace session-name=\"run\"/>\n<executable cmd=\"sleep 1000\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(daemon.wait_for_output("asked", kPatience)) << run.out() << run.err();
  run.send_signal(SIGINT);
  ASSERT_TRUE(run.wait_for_output("user interrupted with ctrl-c (SIGINT)", kPatience)) << run.out() << run.err();
  // A second signal counts when a second has passed.
  do {
    run.send_signal(SIGINT);
  } while (!run.wait_for_output("again, ending at once", std::chrono::milliseconds(1200)));
  if (run.wait_for_output(" does not answer: giving up, launch-guardian cleans up\n", kPatience)) {
    EXPECT_THAT(run.out(),
                ContainsRegex("\\[ERROR\\] \\[launch\\]: trace \\(.*system.launch.xml:2:[0-9]+\\) does not answer"));
  } else {  // on a machine so busy that the limit of LTTng's answers comes before the end of the patience
    EXPECT_THAT(run.err(),
                HasSubstr("cannot create trace session 'run': LTTng does not answer, it was waited for 10 s"))
        << run.out();
  }
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 1);
  daemon.send_signal(SIGKILL);
  daemon.wait();
  Sandbox::wait_until_daemons_are_left();
}

}  // namespace
