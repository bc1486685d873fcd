// SPDX-License-Identifier: Apache-2.0
// Each attribute of <trace>, from the launch file to the session daemon: a process of the launch asks the daemon about
// the session. Context fields, which the daemon does not list, are looked up in the trace.
#include <gmock/gmock.h>

#include <ostream>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

struct Row {
  const char* name;
  std::string attributes;  // of <trace session-name="run">, and its children
  std::string children = {};
  std::vector<std::string> expected;
  std::vector<std::string> absent = {};
  std::string question = "lttng list run";
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.name;
}

class TraceAttributes : public testing::TestWithParam<Row> {};

// The output without the label of the process at the beginning of each line.
std::string answer_in(const std::string& output) {
  std::string answer;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[ask-1] ")) {
      answer += line.substr(8) + "\n";
    }
  }
  return answer;
}

TEST_P(TraceAttributes, AreAsTheDaemonListsThem) {
  const Sandbox sandbox;
  const Row& row = GetParam();
  const auto path = sandbox.directory() / "system.launch.xml";
  write_file(path, "<launch>\n<trace session-name=\"run\" " + row.attributes + ">" + row.children +
                       "</trace>\n<executable name=\"ask\" output=\"screen\" cmd=\"" + row.question +
                       "\"/>\n</launch>\n");
  const CommandResult result = run_command({LAUNCH_PROGRAM, path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string answer = answer_in(result.out);
  for (const std::string& part : row.expected) {
    EXPECT_THAT(answer, HasSubstr(part));
  }
  for (const std::string& part : row.absent) {
    EXPECT_THAT(answer, Not(HasSubstr(part)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, TraceAttributes,
    testing::Values(
        Row{.name = "Defaults",
            .attributes = "",
            .expected = {"Recording session run: [active]", "/traces/run\n", "Domain: User space",
                         "Buffering scheme: per-user", "- ros2: [enabled]", "Event-loss mode:  discard",
                         "Sub-buffer size:  1048576 bytes", "Sub-buffer count: 4", "Switch timer:     5000000 us",
                         "Read timer:       50000 us", "Blocking timeout: 0 us", "Trace file count: 1 per stream",
                         "Trace file size:  unlimited", "Output mode:      mmap",
                         "ros2:rcl_init (type: tracepoint) [enabled]", "launch:* (type: tracepoint) [enabled]"}},
        Row{.name = "BasePath", .attributes = R"(base-path="$(dirname)/elsewhere")", .expected = {"/elsewhere/run\n"}},
        Row{.name = "AppendTimestamp",
            .attributes = R"(append-timestamp="true")",
            .expected = {"/traces/run-2"},
            .question = "lttng list"},
        Row{.name = "Events",
            .attributes = R"(events-ust="'ros2:rmw_take if taken == 1' 'my:* level WARNING'" launch-events="false")",
            .expected = {"ros2:rmw_take (type: tracepoint) [enabled] [filter: 'taken == 1']",
                         "my:* (loglevel <= TRACE_WARNING (4)) (type: tracepoint) [enabled]"},
            .absent = {"launch:*", "ros2:rcl_init"}},
        Row{.name = "Loggers",
            .attributes = R"(events-python="planner:* 'costs level ERR'" subbuffer-size-ust="65536")",
            .expected = {"Domain: Python", "- planner [enabled]", "- planner.* [enabled]", "- costs [enabled]",
                         "int_loglevel >= 40", "- lttng_python_channel: [enabled]"}},
        Row{.name = "Buffers",
            .attributes = R"(subbuffer-size-ust="65536" subbuffer-count-ust="8" read-timer-ust="12345"
                switch-timer-ust="500000" tracefile-size="1048576" tracefile-count="3" overwrite-ust="true" buffers-ust="pid")",
            .expected = {"Buffering scheme: per-process", "Event-loss mode:  overwrite",
                         "Sub-buffer size:  65536 bytes", "Sub-buffer count: 8", "Switch timer:     500000 us",
                         "Read timer:       12345 us", "Trace file count: 3 per stream",
                         "Trace file size:  1048576 bytes"}},
        Row{.name = "BlockingTimeout",
            .attributes = R"(blocking-timeout-ust="1500")",
            .expected = {"Blocking timeout: 1500 us"}},
        Row{.name = "InitChannel",
            .attributes = R"(init-channel="true")",
            .expected = {"- ros2: [enabled]", "- ros2_init: [enabled]"}},
        Row{.name = "Channels",
            .attributes = R"(events-ust="ros2:*")",
            .children =
                R"(<channel name="mine" events-ust="my:*" subbuffer-size="8192" subbuffer-count="16" read-timer="777"
                switch-timer="888000" overwrite="true"/><channel name="other" events-ust="other:*" blocking-timeout="10"/>)",
            .expected = {"- mine: [enabled]", "Sub-buffer size:  8192 bytes", "Sub-buffer count: 16",
                         "Read timer:       777 us", "Switch timer:     888000 us", "my:* (type: tracepoint) [enabled]",
                         "- other: [enabled]", "Blocking timeout: 10 us"}},
        Row{.name = "SnapshotMode",
            .attributes = R"(snapshot-mode="true")",
            .expected = {"Recording session run: [active snapshot]", "Event-loss mode:  overwrite"}},
        Row{.name = "SnapshotSize",
            .attributes = R"(snapshot-mode="true" snapshot-size="99999744")",
            .expected = {"/traces/run", "(max size: 99999744 bytes)"},
            .question = "lttng snapshot list-output -s run"},
        Row{.name = "SnapshotOnEvents",
            .attributes = R"(snapshot-on-events="'ros2:rcl_init if version == 5'")",
            .expected = {"name: run:0", "ros2:rcl_init", "version == 5"},
            .question = "lttng list-triggers"},
        Row{.name = "DualSession",
            .attributes = R"(dual-session="true")",
            .expected = {"Recording session run-snapshot: [active snapshot]", "ros2:rcl_init (type: tracepoint)"},
            .absent = {"ros2:callback_start"},
            .question = "lttng list run-snapshot"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(TraceContextFields, AreInTheTrace) {
  const Sandbox sandbox;
  const auto path = sandbox.directory() / "system.launch.xml";
  write_file(path,
             "<launch>\n<trace session-name=\"run\" context-fields=\"vtid pthread_id\"/>\n<executable cmd=\"" TRACED_APP
             " 1 1 abort\"/>\n</launch>\n");
  run_command({LAUNCH_PROGRAM, path.string()});
  const std::string text = run_command({"babeltrace2", (sandbox.trace_directory() / "run").string()}).out;
  EXPECT_THAT(text, testing::ContainsRegex(
                        "ros2:rcl_init: \\{ cpu_id = [0-9]+ \\}, \\{ vtid = [0-9]+, pthread_id = [0-9]+ \\}"));
}

// A program in Python, as a node of rclpy would be.
constexpr const char* kPythonProgram = R"py(import logging
import lttngust
logging.getLogger('planner').info('a plan')
logging.getLogger('planner.local').warning('a local plan')
logging.getLogger('costs').info('not severe enough')
logging.getLogger('costs').error('too dear')
logging.getLogger('elsewhere').error('not asked for')
)py";

class TracePython : public testing::Test {
 protected:
  void SetUp() override {
    if (run_command({"/usr/bin/python3", "-c", "import lttngust"}).exit_code != 0) {
      GTEST_SKIP() << "skipped, because Python has no module lttngust (python3-lttngust)";
    }
  }

  CommandResult launch(const std::string& attributes, const std::string& program) {
    const auto path = sandbox_.directory() / "system.launch.xml";
    write_file(sandbox_.directory() / "app.py", program);
    write_file(path, "<launch>\n<trace session-name=\"run\" " + attributes +
                         "/>\n<executable cmd=\"/usr/bin/python3 $(dirname)/app.py\"/>\n</launch>\n");
    return run_command({LAUNCH_PROGRAM, path.string()});
  }

  Sandbox sandbox_;
  const std::string trace_ = (sandbox_.trace_directory() / "run").string();
};

TEST_F(TracePython, LoggersAreRecordedByName) {
  for (const char* const owner : {"uid", "pid"}) {
    const CommandResult result = launch("append-trace=\"true\" buffers-ust=\"" + std::string(owner) +
                                            "\" events-python=\"planner:* 'costs level WARNING'\"",
                                        kPythonProgram);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
  }
  const std::string text = run_command({LAUNCH_PROGRAM, "trace", "read", trace_}).out;
  for (const char* const part : {"lttng_python:event", "a plan", "a local plan", "too dear", "planner.local"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, Not(HasSubstr("not severe enough")));
  EXPECT_THAT(text, Not(HasSubstr("not asked for")));
  const std::string report = run_command({LAUNCH_PROGRAM, "report", trace_, "--json"}).out;
  EXPECT_THAT(report, HasSubstr("lttng_python:event (planner)"));
  EXPECT_THAT(report, HasSubstr("lttng_python:event (planner.local)"));
  EXPECT_THAT(report, HasSubstr("lttng_python:event (costs)"));
}

TEST_F(TracePython, AProgramThatDoesNotImportTheModuleIsToldOf) {
  const CommandResult result =
      launch("events-python=\"*\"", "import logging\nlogging.getLogger('planner').error('x')\n");
  EXPECT_THAT(result.out + result.err,
              HasSubstr("no Python program that ran tells LTTng what it logs: it has to import lttngust"));
}

TEST_F(TracePython, ACommandRecordsAndListsLoggers) {
  run_command({LAUNCH_PROGRAM, "trace", "start", "run", "--python", "planner", "--ust", "ros2:*"});
  const CommandResult status = run_command({LAUNCH_PROGRAM, "trace", "status", "run"});
  EXPECT_THAT(status.out, HasSubstr("ust channel lttng_python_channel")) << status.err;
  EXPECT_THAT(status.out, HasSubstr("1 event rule: planner\n"));
  write_file(sandbox_.directory() / "app.py", kPythonProgram);
  run_command({"/usr/bin/python3", (sandbox_.directory() / "app.py").string()});
  const CommandResult stopped = run_command({LAUNCH_PROGRAM, "trace", "stop", "run"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_THAT(run_command({"babeltrace2", trace_}).out, HasSubstr("msg = \"a plan\", logger_name = \"planner\""));
}

constexpr const char* kFiresAndEnds = "sh -c '" TRACED_APP " 1 1 &lt;/dev/null'";

CommandResult launch_with_report(const Sandbox& sandbox, const std::string& attributes, const std::string& command) {
  const auto path = sandbox.directory() / "system.launch.xml";
  write_file(path, "<launch>\n<trace session-name=\"run\" report=\"true\" " + attributes + "/>\n<executable cmd=\"" +
                       command + "\"/>\n</launch>\n");
  return run_command({LAUNCH_PROGRAM, path.string()});
}

TEST(TraceReport, IsMadeAtTheEnd) {
  const Sandbox sandbox;
  const CommandResult result = launch_with_report(sandbox, "", kFiresAndEnds);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string page = (sandbox.trace_directory() / "run/report.html").string();
  EXPECT_THAT(result.out + result.err, HasSubstr("report: " + page + "\n"));
  EXPECT_THAT(run_command({"head", "-c", "100", page}).out, testing::StartsWith("<!DOCTYPE html>"));
}

TEST(TraceReport, IsMadeOfALaunchWithoutATrace) {
  const Sandbox sandbox;
  const auto path = sandbox.directory() / "system.launch.xml";
  write_file(path, std::string("<launch>\n<executable cmd=\"") + kFiresAndEnds + "\"/>\n</launch>\n");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "--report", path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out + result.err, testing::ContainsRegex("report: .*/traces/system-[0-9]+/report.html\n"));
}

TEST(TraceReport, TellsWhyThereIsNone) {
  const Sandbox sandbox;
  const CommandResult result = launch_with_report(sandbox, "launch-events=\"false\"", "true");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out + result.err, HasSubstr("no report: see what `launch report " +
                                                 (sandbox.trace_directory() / "run").string() + "` says\n"));
}

TEST(TraceReport, IsNamedByACommandThatAShellReads) {
  const Sandbox sandbox;
  const auto path = sandbox.directory() / "system.launch.xml";
  write_file(path, "<launch>\n<trace session-name=\"a run\"/>\n<executable cmd=\"true\"/>\n</launch>\n");
  const CommandResult result = run_command({LAUNCH_PROGRAM, path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out + result.err,
              HasSubstr("what is in it: launch report '" + (sandbox.trace_directory() / "a run").string() + "'\n"));
}

}  // namespace
