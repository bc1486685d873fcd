// Events of the kernel beside those of userspace, recorded through tracefs where LTTng's modules are not there.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::HasSubstr;

// Lists the instances, for which tracefs must be mounted.
constexpr const char* kSeeTracefs =
    "ls /sys/kernel/tracing/instances 2>/dev/null || "
    "{ mount -t tracefs none /sys/kernel/tracing && ls /sys/kernel/tracing/instances; }";

class KernelTrace : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "skipped, because the kernel is traced by root alone";
    if (run_command({"unshare", "-m", "sh", "-c", kSeeTracefs}).exit_code != 0) {
      GTEST_SKIP() << "skipped, because tracefs can't be mounted here";
    }
  }

  CommandResult launch(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return run_command({LAUNCH_PROGRAM, path});
  }

  static std::vector<std::string> lines_of(const fs::path& directory) {
    const CommandResult read = run_command({"babeltrace2", directory.string()});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    std::vector<std::string> lines;
    std::istringstream out(read.out);
    for (std::string line; std::getline(out, line);) lines.push_back(line);
    return lines;
  }

  // The number after `key` in the first of the lines from `begin` on that has all the texts; -1 for none. The index of
  // the line is left in `found`.
  static long number_in(const std::vector<std::string>& lines, const std::vector<std::string>& texts,
                        const std::string& key, std::size_t& found, std::size_t begin = 0) {
    for (std::size_t i = begin; i < lines.size(); ++i) {
      if (!std::all_of(texts.begin(), texts.end(),
                       [&](const std::string& text) { return lines[i].find(text) != std::string::npos; })) {
        continue;
      }
      found = i;
      const std::size_t value = lines[i].find(key + " = ");
      return value == std::string::npos ? -1 : std::stol(lines[i].substr(value + key.size() + 3));
    }
    return -1;
  }

  // The kernel has its instances once for all sandboxes.
  const std::string session_ = "kernel_test_" + std::to_string(getpid());
  Sandbox sandbox_;
};

TEST_F(KernelTrace, KernelAndUserspaceEventsStandInOneOrderWithTheRightThreads) {
  const CommandResult result = launch(R"xml(
    <trace session-name=")xml" + session_ +
                                      R"xml(" events-kernel="sched_switch sched_process_exec" syscalls="exit_group"/>
    <executable cmd="sh -c ')xml" TRACED_APP R"xml( 3 10 &lt;/dev/null'"/>)xml");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("they are recorded through tracefs instead"));
  const fs::path directory = sandbox_.trace_directory() / session_;
  EXPECT_FALSE(fs::exists(directory / "kernel-recorder.pid"));
  EXPECT_THAT(read_file(directory / "verdict.json"), HasSubstr("\"domain\": \"kernel\""));

  const std::vector<std::string> lines = lines_of(directory);
  std::size_t exec = 0;
  std::size_t fired = 0;
  std::size_t exited = 0;
  const long application = number_in(lines, {"ros2:rcl_init"}, "vtid", fired);
  ASSERT_GT(application, 0);
  const std::string tid = "tid = " + std::to_string(application) + " }";
  // sched_process_exec, then the application's own event, then its exit_group, each with its thread.
  EXPECT_EQ(number_in(lines, {"sched_process_exec: ", tid, "traced_app"}, "tid", exec), application);
  EXPECT_EQ(number_in(lines, {"syscall_entry_exit_group: ", tid}, "tid", exited), application);
  EXPECT_LT(exec, fired);
  EXPECT_LT(fired, exited);
  std::size_t switched = 0;
  EXPECT_EQ(
      number_in(lines, {"sched_switch: ", "next_tid = " + std::to_string(application) + ","}, "next_tid", switched),
      application)
      << "the scheduler let it run";
  EXPECT_EQ(number_in(lines, {"launch:exec"}, "vtid", switched) > 0, true);
}

TEST_F(KernelTrace, UnknownEventsAreAnErrorAtTheTraceAndLeaveNothing) {
  const CommandResult result = launch("<trace session-name=\"" + session_ + "\" events-kernel=\"sched_swich\"/>");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr(":2:2: error: tracing setup failed: kernel events cannot be recorded: the kernel has "
                        "no event 'sched_swich'"));
  EXPECT_THAT(run_command({"lttng", "list"}).out, HasSubstr("Currently no available recording session"));
  EXPECT_EQ(run_command(
                {"unshare", "-m", "sh", "-c", "{ " + std::string(kSeeTracefs) + "; } | grep ^launch-" + session_ + "$"})
                .out,
            "");
}

TEST_F(KernelTrace, TheExampleRecordsWhoRan) {
  for (const std::string format : {"xml", "yaml"}) {
    const CommandResult result = run_command({LAUNCH_PROGRAM, EXAMPLES_DIRECTORY "/24_kernel.launch." + format});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
  }
}

TEST_F(KernelTrace, RecordsFromACommandUntilAnotherStopsIt) {
  ASSERT_EQ(run_command({LAUNCH_PROGRAM, "trace", "start", session_, "-k", "sched_process_exec"}).exit_code, 0);
  run_command({"true"});
  const CommandResult stopped = run_command({LAUNCH_PROGRAM, "trace", "stop", session_});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  std::size_t found = 0;
  EXPECT_GT(
      number_in(lines_of(sandbox_.trace_directory() / session_), {"sched_process_exec: ", "/true\""}, "tid", found), 0);
}

}  // namespace
