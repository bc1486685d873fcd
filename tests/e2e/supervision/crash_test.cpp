// SPDX-License-Identifier: Apache-2.0
// The bundle that is made of a crash.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::SizeIs;

constexpr std::chrono::seconds kPatience(60);

class CrashTest : public testing::Test {
 protected:
  CommandResult launch(std::vector<std::string> words, const std::string& actions) {
    const fs::path file = sandbox_.directory() / "system.launch.xml";
    write_file(file, "<launch>\n" + actions + "\n</launch>\n");
    words.insert(words.begin(), LAUNCH_PROGRAM);
    words.push_back(file.string());
    return run_command({.argv = std::move(words), .directory = sandbox_.directory()}, kPatience);
  }

  std::vector<fs::path> bundles() const {
    std::vector<fs::path> found;
    if (fs::exists(crashes_)) {
      std::copy(fs::directory_iterator(crashes_), fs::directory_iterator(), std::back_inserter(found));
    }
    return found;
  }

  // Why the kernel of this machine writes no core that a test can find; empty: it writes one.
  static std::string no_cores() {
    rlimit limit{};
    getrlimit(RLIMIT_CORE, &limit);
    if (limit.rlim_max == 0) {
      return "skipped, because the hard limit of core files is 0";
    }
    return read_file("/proc/sys/kernel/core_pattern").starts_with('|')
               ? "skipped, because the kernel gives cores to a program"
               : "";
  }

  Sandbox sandbox_;
  fs::path crashes_ = sandbox_.directory() / "crashes";
};

TEST_F(CrashTest, HasEveryThreadTheLastLinesAndTheCore) {
  if (const std::string reason = no_cores(); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  const CommandResult result =
      launch({"--crash-dir", "crashes"}, R"xml(<executable name="worker" cmd=")xml" CRASHING_WORKER R"xml("/>)xml");
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  ASSERT_THAT(bundles(), SizeIs(1)) << result.out;
  const fs::path bundle = bundles()[0];
  EXPECT_THAT(result.out, HasSubstr("crash bundle of worker-1: " + bundle.string() + "\n"));
  EXPECT_THAT(bundle.filename().string(), MatchesRegex("worker-1-[0-9]+-[0-9]+-[0-9]+"));
  EXPECT_EQ(fs::status(bundle).permissions(), fs::perms::owner_all);
  const std::string summary = read_file(bundle / "crash.txt");
  EXPECT_THAT(summary, AllOf(HasSubstr("worker-1: SIGSEGV, core dumped, after"), HasSubstr("system.launch.xml:2:2\n"),
                             HasSubstr("cause:      SIGSEGV at address 0x10, where no file is mapped\n"),
                             HasSubstr("program:    " CRASHING_WORKER "\n")));
  EXPECT_EQ(read_file(bundle / "output.log"), "line 1\nline 2\nline 3\n");
  EXPECT_THAT(read_file(bundle / "maps.txt"), AllOf(HasSubstr(CRASHING_WORKER), HasSubstr("libc")));
  EXPECT_GT(fs::file_size(bundle / "core"), 0U);
  const std::string backtrace = read_file(bundle / "backtrace.txt");
  if (summary.find("gdb is not installed") == std::string::npos) {
    EXPECT_THAT(backtrace, AllOf(HasSubstr("read_through"), HasSubstr("wait_in_another_thread")));
  } else {
    EXPECT_THAT(backtrace, HasSubstr("gdb is not installed"));
  }
  for (const auto& entry : fs::directory_iterator(sandbox_.directory())) {
    EXPECT_THAT(entry.path().filename().string(), Not(testing::StartsWith("core"))) << "it is in the bundle";
  }
}

TEST_F(CrashTest, CanBeRunAgainWithItsParameters) {
  write_file(sandbox_.directory() / "numbers.yaml", "rate: 7\n");
  const CommandResult result = launch({}, R"xml(<let name="crash-dir" value="crashes"/>
<executable name="tool" cmd="sh -c 'echo out; echo $WORD; cat $2; exit 4' sh --params-file numbers.yaml">
  <env name="WORD" value="it's"/>
</executable>)xml");
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  ASSERT_THAT(bundles(), SizeIs(1)) << result.out;
  const fs::path bundle = bundles()[0];
  EXPECT_EQ(read_file(bundle / "output.log"), "out\nit's\nrate: 7\n");
  EXPECT_EQ(read_file(bundle / "backtrace.txt"),
            "There is no backtrace. The process has ended by itself with exit code 4, so there is no core.\n");
  EXPECT_FALSE(fs::exists(bundle / "core"));
  fs::remove(sandbox_.directory() / "numbers.yaml");
  const CommandResult again = run_command({(bundle / "command.sh").string()});
  EXPECT_EQ(again.exit_code, 4);
  EXPECT_EQ(again.out, "out\nit's\nrate: 7\n");
}

TEST_F(CrashTest, IsNotAnEndThatWasAskedForOrIsAllowed) {
  const CommandResult result =
      launch({"--crash-dir", "crashes"}, R"xml(<executable cmd="sh -c 'exit 4'" allowed-exit-codes="4"/>
<executable cmd="sleep 1000" name="sleeper"/>
<executable cmd="false" crash-dir=""/>
<on_process_start process="sleeper"><shutdown/></on_process_start>)xml");
  EXPECT_THAT(bundles(), IsEmpty()) << result.out;
}

TEST_F(CrashTest, OfOneProcessMakesFiveBundlesAtMost) {
  const CommandResult result = launch(
      {}, R"xml(<executable name="a" cmd="false" crash-dir="crashes" respawn="true" respawn_max_retries="6"/>)xml");
  EXPECT_THAT(bundles(), SizeIs(5)) << result.out;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch]: a-1 has crashed 6 times; there are no more crash bundles of it\n"));
}

TEST_F(CrashTest, HoldsTheSnapshotOfAFlightRecorder) {
  const CommandResult result = launch({"--crash-dir", "crashes"},
                                      R"xml(<trace session-name="run" snapshot-on-crash="true" events-ust="ros2:*"/>
<executable name="app" cmd=")xml" TRACED_APP R"xml( 1 3 abort"/>)xml");
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  ASSERT_THAT(bundles(), SizeIs(1)) << result.out;
  EXPECT_THAT(read_file(bundles()[0] / "crash.txt"), HasSubstr("app-1: SIGABRT"));
  if (no_cores().empty()) {
    EXPECT_THAT(read_file(bundles()[0] / "crash.txt"), HasSubstr("cause:      the process has sent itself SIGABRT\n"));
  }
  EXPECT_THAT(read_file(bundles()[0] / "snapshot/verdict.json"), HasSubstr("app-1 died of SIGABRT"));
}

TEST_F(CrashTest, OfADeadlineHasTheProcessThatWasLateAndTheSnapshot) {
  const fs::path file = sandbox_.directory() / "system.launch.xml";
  write_file(file,
             "<launch><trace session-name=\"run\" snapshot-on-late-callback=\"20\"/>\n"
             "<executable name=\"late\" cmd=\"" TRACE_COST_NODE
             " 30\"/>\n"
             "<executable name=\"other\" cmd=\"sleep 1000\"/></launch>");
  RunningCommand run(
      {.argv = {LAUNCH_PROGRAM, "--crash-dir", "crashes", file.string()}, .directory = sandbox_.directory()});
  ASSERT_TRUE(run.wait_for_output("bundle of a deadline that late-1 has missed: ", kPatience))
      << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
  ASSERT_THAT(bundles(), SizeIs(1)) << run.out();
  const fs::path bundle = bundles()[0];
  EXPECT_THAT(read_file(bundle / "deadline.txt"), HasSubstr("late-1: a callback took more than 20 ms\n"));
  EXPECT_THAT(read_file(bundle / "threads.txt"), ContainsRegex("[0-9]+ trace_cost_node waits in "));
  EXPECT_THAT(read_file(bundle / "maps.txt"), HasSubstr("trace_cost_node"));
  EXPECT_THAT(read_file(bundle / "command.sh"), HasSubstr("trace_cost_node 30"));
  EXPECT_THAT(read_file(bundle / "snapshot/verdict.json"), HasSubstr("a callback took more than 20 ms"));
}

TEST_F(CrashTest, InADirectoryThatCannotBeMadeIsToldOf) {
  write_file(sandbox_.directory() / "file", "");
  const CommandResult result = launch({"--crash-dir", "file/crashes"}, R"xml(<executable cmd="false"/>)xml");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, ContainsRegex("\\[WARNING\\] \\[launch\\]: no crash bundle: .*Not a directory"));
}

}  // namespace
