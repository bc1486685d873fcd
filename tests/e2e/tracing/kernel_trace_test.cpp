// SPDX-License-Identifier: Apache-2.0
// Events of the kernel beside those of userspace, recorded through tracefs because LTTng's modules are missing.
#include <gmock/gmock.h>

#include "tests/e2e/tracing/kernel_trace_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST_F(KernelTrace, KernelAndUserspaceEventsStandInOneOrderWithTheRightThreads) {
  // In a container the kernel's process ids differ from those that the programs see.
  if (fs::read_symlink("/proc/self/ns/pid") != "pid:[4026531836]") {
    GTEST_SKIP() << "skipped, because this is not the first process id namespace";
  }
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
  const std::string tid = "vtid = " + std::to_string(application) + " }";
  // First sched_process_exec, then the application's own event, then its exit_group, each with its thread.
  EXPECT_EQ(number_in(lines, {"sched_process_exec: ", tid, "traced_app"}, "vtid", exec), application);
  EXPECT_EQ(
      number_in(lines,
                {"syscall_entry_exit_group: ", tid, "procname = \"traced_app\", vpid = " + std::to_string(application)},
                "vtid", exited),
      application);
  EXPECT_LT(exec, fired);
  EXPECT_LT(fired, exited);
  std::size_t switched = 0;
  EXPECT_EQ(
      number_in(lines, {"sched_switch: ", "next_tid = " + std::to_string(application) + ","}, "next_tid", switched),
      application)
      << "the scheduler let it run";
  EXPECT_EQ(number_in(lines, {"launch:exec"}, "vtid", switched) > 0, true);
}

TEST_F(KernelTrace, SeveralTracesRecordEachItsOwnEvents) {
  const CommandResult result = launch(
      "<trace session-name=\"" + session_ + "a\" events-kernel=\"sched_process_exec\"/>" + "<trace session-name=\"" +
      session_ + "b\" events-kernel=\"sched_process_exit\" context-fields-kernel=\"pid tid\"/>" +
      "<executable cmd=\"true\"/>");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  std::size_t found = 0;
  const auto first = lines_of(sandbox_.trace_directory() / (session_ + "a"));
  const auto second = lines_of(sandbox_.trace_directory() / (session_ + "b"));
  EXPECT_GT(number_in(first, {"sched_process_exec: ", "/true\"", "procname = \"true\""}, "vpid", found), 0);
  EXPECT_EQ(number_in(first, {"sched_process_exit: "}, "vpid", found), -1);
  EXPECT_GT(number_in(second, {"sched_process_exit: ", "comm = \"true\""}, "pid", found), 0);
  EXPECT_EQ(number_in(second, {"sched_process_exec: "}, "pid", found), -1);
}

TEST_F(KernelTrace, WhatHappensDuringAPauseIsNotRecorded) {
  const auto trace = [this](const std::string& verb, const std::vector<std::string>& more = {}) {
    std::vector<std::string> argv = {LAUNCH_PROGRAM, "trace", verb, session_};
    argv.insert(argv.end(), more.begin(), more.end());
    const CommandResult result = run_command(argv);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  const auto run_as = [this](const std::string& name) {
    const fs::path copy = sandbox_.directory() / name;
    fs::copy_file("/bin/true", copy);
    run_command({copy.string()});
  };
  const auto recorded = [this](const std::string& name) {
    std::size_t found = 0;
    return number_in(lines_of(sandbox_.trace_directory() / session_), {"sched_process_exec: ", "/" + name + "\""},
                     "vpid", found) > 0;
  };
  trace("start", {"-k", "sched_process_exec"});
  run_as("before");
  trace("pause");
  EXPECT_TRUE(recorded("before")) << "what is recorded can be read in a pause";
  run_as("meanwhile");
  trace("resume");
  run_as("after");
  trace("stop");
  EXPECT_TRUE(recorded("before"));
  EXPECT_FALSE(recorded("meanwhile"));
  EXPECT_TRUE(recorded("after"));
}

TEST_F(KernelTrace, TheExampleRecordsWhoRan) {
  for (const std::string format : {"xml", "yaml"}) {
    const CommandResult result = run_command({LAUNCH_PROGRAM, EXAMPLES_DIRECTORY "/24_kernel.launch." + format});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
  }
}

#ifdef WITH_PYTHON
// The list has LTTng's own events and others that this kernel hasn't.
TEST_F(KernelTrace, ThePublishedLaunchFileOfTheReferenceSystemRuns) {
  if (fs::read_symlink("/proc/self/ns/pid") != "pid:[4026531836]") {
    GTEST_SKIP() << "skipped, because this is not the first process id namespace";
  }
  const fs::path file = sandbox_.directory() / "system.launch.py";
  fs::copy_file(EXAMPLES_DIRECTORY "/30_reference_system.launch.py", file);
#ifdef __SANITIZE_THREAD__
  const char* length = "length:=20.0";  // the nodes take seconds to start
#else
  const char* length = "length:=2.0";
#endif
  const CommandResult result = run_command({LAUNCH_PROGRAM, file, length});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("not recorded, for the kernel has no event 'lttng_statedump_process_state'"));
  EXPECT_THAT(result.out, HasSubstr("sched_migrate'"));
  fs::path directory;
  for (const auto& entry : fs::directory_iterator(sandbox_.directory())) {
    if (entry.path().filename().string().starts_with("system-")) {
      directory = entry.path();
    }
  }
  const std::vector<std::string> lines = lines_of(directory);
  std::size_t found = 0;
  const long process = number_in(lines, {"ros2:callback_start: "}, "vpid", found);
  EXPECT_GT(process, 0);
  EXPECT_EQ(number_in(lines, {"timer_hrtimer_start: ", "vpid = " + std::to_string(process) + ","}, "vpid", found),
            process);
}
#endif

TEST_F(KernelTrace, RecordsFromACommandUntilAnotherStopsIt) {
  ASSERT_EQ(run_command({LAUNCH_PROGRAM, "trace", "start", session_, "-k", "sched_process_exec"}).exit_code, 0);
  run_command({"true"});
  const CommandResult stopped = run_command({LAUNCH_PROGRAM, "trace", "stop", session_});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  std::size_t found = 0;
  EXPECT_GT(
      number_in(lines_of(sandbox_.trace_directory() / session_), {"sched_process_exec: ", "/true\""}, "vtid", found),
      0);
}

// The recorder's own writing and the load make events as fast as the recorder reads them.
TEST_F(KernelTrace, EndsUnderALoadOfEvents) {
  ASSERT_EQ(
      run_command({LAUNCH_PROGRAM, "trace", "start", session_, "-k", "sched_switch", "--syscall", "read", "write"})
          .exit_code,
      0);
  const Command load{.argv = {"dd", "if=/dev/zero", "of=/dev/null", "bs=1"}};
  const RunningCommand first(load);
  const RunningCommand second(load);
  run_command({"dd", "if=/dev/zero", "of=/dev/null", "bs=1", "count=200000"});
  const CommandResult stopped = run_command({LAUNCH_PROGRAM, "trace", "stop", session_});
  EXPECT_FALSE(stopped.timed_out);
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  const fs::path kernel = sandbox_.trace_directory() / session_ / "kernel";
  EXPECT_GT(fs::file_size(kernel / "metadata"), 0u);
  EXPECT_FALSE(fs::exists(kernel.parent_path() / "kernel-recorder.pid"));
}

TEST_F(KernelTrace, WhatTheRecorderAndTheConsumerDoIsNotRecorded) {
  if (fs::read_symlink("/proc/self/ns/pid") != "pid:[4026531836]") {
    GTEST_SKIP() << "skipped, because this is not the first process id namespace";
  }
  ASSERT_EQ(run_command({LAUNCH_PROGRAM, "trace", "start", session_, "-k", "sched_switch", "--syscall", "*"}).exit_code,
            0);
  // Other tests may have recorders and consumers of their own beside this one; the kernel's events have them, too.
  long recorder = 0;
  std::ifstream(sandbox_.trace_directory() / session_ / "kernel-recorder.pid") >> recorder;
  ASSERT_GT(recorder, 0);
  const std::vector<long> consumers = own_consumers();
  ASSERT_FALSE(consumers.empty());
  run_command({"sh", "-c", TRACED_APP " 10000 10 </dev/null"});
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "trace", "stop", session_}).exit_code, 0);
  const auto made_by = [](const std::string& line, long process) {
    return line.find("vpid = " + std::to_string(process) + ",") != std::string::npos;
  };
  std::size_t system_calls = 0;
  bool switched_to_recorder = false;
  for (const std::string& line : lines_of(sandbox_.trace_directory() / session_)) {
    switched_to_recorder =
        switched_to_recorder || line.find("next_tid = " + std::to_string(recorder) + ",") != std::string::npos;
    if (line.find("syscall_entry_") == std::string::npos) {
      continue;
    }
    ++system_calls;
    EXPECT_FALSE(made_by(line, recorder)) << line;
    for (const long consumer : consumers) {
      EXPECT_FALSE(made_by(line, consumer)) << line;
    }
  }
  EXPECT_GT(system_calls, 0U);
  EXPECT_TRUE(switched_to_recorder) << "the scheduler's events have no gap";
}

}  // namespace
