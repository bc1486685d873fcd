// SPDX-License-Identifier: Apache-2.0
// Kernel events that can't be recorded: what the launcher says, and to whom.
#include <gmock/gmock.h>

#include "tests/e2e/tracing/kernel_trace_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST_F(KernelTrace, UnknownEventsAreAnErrorAtTheTraceAndLeaveNothing) {
  const CommandResult result = launch("<trace session-name=\"" + session_ + "\" events-kernel=\"sched_swich\"/>");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr(":2:2: error: tracing setup failed: kernel events cannot be recorded: the kernel has "
                        "no event 'sched_swich'"));
  EXPECT_THAT(run_command({"lttng", "list"}).out, HasSubstr("Currently no available recording session"));
  EXPECT_FALSE(fs::exists(sandbox_.trace_directory() / session_)) << "another try finds the place free";
  EXPECT_EQ(run_command(
                {"unshare", "-m", "sh", "-c", "{ " + std::string(kSeeTracefs) + "; } | grep ^launch-" + session_ + "$"})
                .out,
            "");
}

TEST_F(KernelTrace, UnknownEventsBesideKnownOnesAreAWarning) {
  const CommandResult result =
      launch("<trace session-name=\"" + session_ +
             "\" events-kernel=\"lttng_statedump_start sched_process_exec sched_swich\" syscalls=\"opennat\"/>" +
             "<executable cmd=\"true\"/>");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("not recorded, for the kernel has no event 'lttng_statedump_start', no event "
                                    "'sched_swich', no system call 'opennat'\n"));
  std::size_t found = 0;
  EXPECT_GT(number_in(lines_of(sandbox_.trace_directory() / session_), {"sched_process_exec: "}, "vpid", found), 0);
}

TEST_F(KernelTrace, ContextFieldsThatTracefsDoesNotTellAreAnErrorAtTheTrace) {
  const CommandResult result = launch("<trace session-name=\"" + session_ +
                                      "\" events-kernel=\"sched_switch\" context-fields-kernel=\"tid nice\"/>");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr(":2:2: error: tracing setup failed: context field 'nice' of kernel events cannot be "
                        "recorded without LTTng's kernel modules\n"));
  EXPECT_THAT(result.err, HasSubstr("= help: give context-fields-kernel some of procname, pid, tid, vpid and vtid; or "
                                    "install lttng-modules-dkms"));
}

// The kernel's numbers are others than those in a container: a thread of the machine must not be taken for a node's.
TEST_F(KernelTrace, InAContainerProcessesHaveTheirNamespace) {
  const fs::path path = sandbox_.directory() / "system.launch.xml";
  write_file(path, "<launch>\n<trace session-name=\"" + session_ + R"(" events-kernel="sched_switch"/>
<executable cmd="sh -c ')" TRACED_APP R"( 3 10 &lt;/dev/null'"/>
</launch>
)");
  const CommandResult result =
      run_command({"unshare", "--pid", "--fork", "--kill-child", "--mount-proc", LAUNCH_PROGRAM, path});
  EXPECT_THAT(result.out + result.err,
              HasSubstr("this launch has a namespace of process ids: the kernel's events have other numbers for its "
                        "threads, so they do not tell where the time of its callbacks goes; LTTng's modules know both "
                        "numbers"));
  std::size_t of_nodes = 0;
  for (const std::string& line : lines_of(sandbox_.trace_directory() / session_)) {
    const bool is_of_kernel = line.find(" sched_switch: ") != std::string::npos;
    EXPECT_EQ(line.find("pid_ns = ") == std::string::npos, is_of_kernel) << line;
    of_nodes += is_of_kernel ? 0 : 1;
  }
  EXPECT_GT(of_nodes, 0U);
}

TEST_F(KernelTrace, WhoIsNotRootIsToldWhatToDo) {
  const std::vector<std::string> as_nobody = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  std::vector<std::string> reach = as_nobody;
  reach.insert(reach.end(), {"test", "-x", LAUNCH_PROGRAM});
  if (run_command({reach}).exit_code != 0) {
    GTEST_SKIP() << "skipped, because other users can't reach the build";
  }
  const fs::path path = sandbox_.directory() / "system.launch.xml";
  write_file(path, "<launch>\n<trace session-name=\"run\" events-kernel=\"sched_switch\"/>\n</launch>\n");
  fs::permissions(sandbox_.directory(), fs::perms::all);
  for (const auto& entry : fs::directory_iterator(sandbox_.directory())) {
    fs::permissions(entry.path(), fs::perms::all);
  }
  std::vector<std::string> run = as_nobody;
  run.insert(run.end(), {LAUNCH_PROGRAM, path.string()});
  const CommandResult result = run_command({run});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(
      result.err,
      path.string() +
          R"(:2:2: error: tracing setup failed: kernel events cannot be recorded: root's session daemon alone records them, and this user has none
    2 | <trace session-name="run" events-kernel="sched_switch"/>
      |  ^~~~~
      = help: run as root; or let root start lttng-sessiond, join the group `tracing` (sudo usermod -aG tracing USER), and log in again
)");
}

}  // namespace
