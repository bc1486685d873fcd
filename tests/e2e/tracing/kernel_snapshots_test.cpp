// SPDX-License-Identifier: Apache-2.0
// Kernel events in the snapshots of a flight recorder.
#include <gmock/gmock.h>

#include "tests/e2e/tracing/kernel_trace_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST_F(KernelTrace, AFlightRecorderHoldsWhatTheKernelDidBeforeTheCrash) {
  const fs::path unlucky = sandbox_.directory() / "unlucky";
  fs::copy_file("/bin/sh", unlucky);
  const CommandResult result =
      launch("<trace session-name=\"" + session_ + "\" snapshot-on-crash=\"true\" events-kernel=\"sched_process_*\"/>" +
             "<executable cmd=\"" + unlucky.string() + " -c '" TRACED_APP " 3 10 &lt;/dev/null; kill -SEGV $$'\"/>");
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("snapshot written to: "));
  const std::vector<fs::path> snapshots = snapshots_of(session_);
  ASSERT_EQ(snapshots.size(), 1U);
  const std::vector<std::string> lines = lines_of(snapshots.front());
  std::size_t exec = 0;
  std::size_t told = 0;
  std::size_t exited = 0;
  const long pid = number_in(lines, {"sched_process_exec: ", "/unlucky\""}, "vpid", exec);
  EXPECT_GT(pid, 0);
  EXPECT_GT(number_in(lines, {"sched_process_exit: ", "comm = \"unlucky\""}, "vpid", exited), 0);
  EXPECT_GT(number_in(lines, {"ros2:rcl_init: "}, "vtid", told), 0);
  EXPECT_LT(exec, told);
  EXPECT_LT(told, exited);
  EXPECT_FALSE(fs::exists(snapshots.front().parent_path() / "kernel-recorder.pid"));
  EXPECT_FALSE(fs::exists(snapshots.front().parent_path() / "kernel-recorder.json"));
}

TEST_F(KernelTrace, ASnapshotByCommandBeginsWhereTheOneBeforeEnded) {
  const auto trace = [this](const std::string& verb, const std::vector<std::string>& more = {}) {
    std::vector<std::string> argv = {LAUNCH_PROGRAM, "trace", verb, session_};
    argv.insert(argv.end(), more.begin(), more.end());
    const CommandResult result = run_command(argv);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  };
  const auto run_as = [this](const std::string& name) {
    const fs::path copy = sandbox_.directory() / name;
    fs::copy_file("/bin/true", copy);
    run_command({copy.string()});
  };
  const auto recorded = [](const fs::path& snapshot, const std::string& name) {
    std::size_t found = 0;
    return number_in(lines_of(snapshot), {"sched_process_exec: ", "/" + name + "\""}, "vpid", found) > 0;
  };
  trace("start", {"--snapshot-mode", "-k", "sched_process_exec"});
  run_as("first");
  trace("record_snapshot");
  run_as("second");
  trace("record_snapshot");
  trace("stop");
  const std::vector<fs::path> snapshots = snapshots_of(session_);
  ASSERT_EQ(snapshots.size(), 2U);
  EXPECT_TRUE(recorded(snapshots[0], "first"));
  EXPECT_FALSE(recorded(snapshots[0], "second"));
  EXPECT_FALSE(recorded(snapshots[1], "first"));
  EXPECT_TRUE(recorded(snapshots[1], "second"));
}

}  // namespace
