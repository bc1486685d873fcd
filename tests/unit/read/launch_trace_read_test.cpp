// SPDX-License-Identifier: Apache-2.0
// Runs the program `launch-trace-read` on traces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing {
namespace {

using test_support::CommandResult;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class LaunchTraceRead : public ::testing::Test {
 protected:
  LaunchTraceRead() {
    testing::TraceWriter writer(path() / "trace");
    for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
      writer.write(thread.vpid == testing::kPing.vpid ? 0 : 1, time, thread, event);
    }
    writer.finish();
  }

  std::filesystem::path path() const { return directory_.path(); }
  CommandResult read(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), LAUNCH_TRACE_READ);
    return test_support::run_command(arguments);
  }
  static std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  testing::TemporaryDirectory directory_;
};

TEST_F(LaunchTraceRead, PrintsEveryEvent) {
  const CommandResult result = read({path()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(lines(result.out), testing::ping_pong_sequence().size());
  EXPECT_THAT(result.out, StartsWith("2026-01-01 00:00:00"));
}

TEST_F(LaunchTraceRead, CountsByName) {
  const CommandResult result = read({path(), "--count", "--event", "*callback_st*", "--event=ros2:rcl_init"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "    3 ros2:callback_start\n    2 ros2:rcl_init\n    5 in all\n");
}

TEST_F(LaunchTraceRead, ChoosesTheEventsOfANode) {
  const std::string events =
      "    2 ros2:callback_end\n    2 ros2:callback_start\n    1 ros2:rcl_node_init\n    1 ros2:rcl_publish\n"
      "    1 ros2:rcl_publisher_init\n    1 ros2:rcl_subscription_init\n    1 ros2:rclcpp_callback_register\n"
      "    2 ros2:rclcpp_executor_execute\n    1 ros2:rclcpp_publish\n"
      "    1 ros2:rclcpp_subscription_callback_added\n    1 ros2:rclcpp_subscription_init\n"
      "    1 ros2:rclcpp_timer_link_node\n    1 ros2:rmw_publish\n    1 ros2:rmw_take\n   17 in all\n";
  for (const char* name : {"/ping", "ping", "pi?g", "*/pin*"}) {
    const CommandResult result = read({path(), "--count", "--node", name});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out, events) << name;
  }
  EXPECT_EQ(lines(read({path(), "--node", "ping", "--node", "/pong"}).out), lines(read({path(), "--node", "*"}).out));
  // The columns of CSV take a reading of their own.
  EXPECT_EQ(lines(read({path(), "--node", "ping", "--format", "csv"}).out), 18u);
}

TEST_F(LaunchTraceRead, SaysThatThereIsNoSuchNode) {
  const CommandResult result = read({path(), "--node", "/nobody"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "launch trace read: warning: no node is called '/nobody'; what was read has /ping, /pong\n");
}

TEST_F(LaunchTraceRead, SaysWhatEventsAndProcessesThereAreInstead) {
  const CommandResult process = read({path(), "--process", "pnig", "--process", "72", "--limit", "100"});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.err,
            "launch trace read: warning: no process is called 'pnig'; what was read has ping [71], pong [72]\n");
  testing::TraceWriter writer(path() / "few", {.identity = 5});
  writer.write(0, 5, testing::kPing, ros2::RclTake{9});
  writer.write(0, 6, testing::kPing, ros2::CallbackStart{3, true});
  writer.finish();
  for (const char* option : {"--count", "--format=text", "--format=csv"}) {
    const CommandResult event =
        read({path() / "few", option, "--event", "ros2:rcl_tak?_it", "--event", "ros2:rcl_take"});
    EXPECT_EQ(event.exit_code, 0);
    EXPECT_EQ(event.err,
              "launch trace read: warning: no event is called 'ros2:rcl_tak?_it'; what was read has "
              "ros2:callback_start, ros2:rcl_take; did you mean 'ros2:rcl_take'?\n")
        << option;
    EXPECT_EQ(read({path() / "few", option, "--event", "ros2:rcl_tak"}).err,
              "launch trace read: warning: no event is called 'ros2:rcl_tak'; what was read has ros2:callback_start, "
              "ros2:rcl_take; did you mean 'ros2:rcl_take'?\n")
        << option;
  }
  // It is there, though not in the time that is wanted.
  EXPECT_EQ(read({path() / "few", "--event", "ros2:rcl_take", "--from", "+0.000000001"}).err, "");
}

TEST_F(LaunchTraceRead, CountsOffsetsFromTheFirstEventOfTheTraceWhateverIsChosen) {
  const std::filesystem::path trace = path() / "offsets";
  testing::TraceWriter writer(trace, {.identity = 6});
  writer.write(0, 100, testing::kPing, ros2::RclTake{9});
  writer.write(0, 150, testing::kPong, ros2::RclNodeInit{1, 2, "other", "/"});
  writer.write(0, 200, testing::kPong, ros2::RclNodeInit{3, 4, "chosen", "/"});
  writer.finish();
  EXPECT_EQ(lines(read({trace, "--node", "/chosen", "--from", "+0.0000001"}).out), 1u);
  EXPECT_EQ(lines(read({trace, "--node", "/chosen", "--from", "+0.000000101"}).out), 0u);
}

TEST_F(LaunchTraceRead, ChoosesAndLimits) {
  const CommandResult result = read({path(), "--process", "pong", "--where", "topic_name == '/ping'", "--limit", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(lines(result.out), 1u);
  EXPECT_THAT(result.out, HasSubstr(" ros2:rcl_subscription_init cpu 1 pong [72/72] "));
}

TEST_F(LaunchTraceRead, SaysThatATraceIsStillBeingWritten) {
  const std::string trace = path() / "trace";
  const std::ofstream writing(path() / "trace/ros2_0", std::ios::binary | std::ios::app);
  const CommandResult result = read({path()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "launch trace read: note: the trace '" + trace + "' is still being written; what is complete is read\n");
  EXPECT_EQ(lines(result.out), testing::ping_pong_sequence().size());
}

TEST_F(LaunchTraceRead, FailsOnLostEventsIfThatIsAskedFor) {
  const std::filesystem::path trace = path() / "lossy";
  testing::TraceWriter writer(trace, {.identity = 4});
  writer.write(0, 5, testing::kPing, ros2::RclTake{9});
  writer.end_packet(0);
  writer.discard_events(0, 3);
  writer.write(0, 6, testing::kPing, ros2::RclTake{9});
  writer.finish();
  EXPECT_EQ(read({trace, "--count"}).exit_code, 0);
  const CommandResult result = read({trace, "--count", "--fail-on", "incomplete"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "launch trace read: error: the trace is incomplete: events were lost\n");
  EXPECT_EQ(read({path(), "--fail-on", "slower"}).exit_code, 2);
}

// LTTng writes the description of an event later than the event.
TEST_F(LaunchTraceRead, SaysThatEventsOfAnOpenTraceAreNotDescribedYet) {
  const std::filesystem::path trace = path() / "open";
  testing::TraceWriter writer(trace, {.identity = 4});
  writer.write(0, 5, testing::kPing, ros2::RclTake{9});
  writer.write_raw(0, 6, testing::kPing, 77, "");
  writer.finish();
  std::ofstream writing(trace / "ros2_0", std::ios::binary | std::ios::app);
  const CommandResult result = read({trace, "--count"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "    1 ros2:rcl_take\n    1 in all\n");
  EXPECT_EQ(result.err,
            "launch trace read: note: the trace '" + trace.string() +
                "' is still being written; what is complete is read\n"
                "launch trace read: note: events that LTTng has not described yet are left out; it describes "
                "them when a traced program ends or the session is stopped\n");
  writing.close();
  EXPECT_EQ(read({trace, "--count"}).exit_code, 1) << "a trace that nobody writes lacks them for ever";
}

TEST_F(LaunchTraceRead, ChoosesByContextsAndPutsThemIntoColumns) {
  testing::TraceWriter writer(path() / "more", {.identity = 4, .vppid = 70});
  writer.write(0, 5, testing::kPing, ros2::RclTake{9});
  writer.finish();
  const CommandResult result = read({path(), "--where", "vppid == 70", "--format", "csv"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "time_ns,event,cpu_id,vpid,vtid,procname,message,vppid\n5,ros2:rcl_take,0,71,71,ping,9,70\n");
}

// The damage at the end of the last packet shows that the rest is not read.
TEST_F(LaunchTraceRead, ReadsNoFurtherThanItMust) {
  testing::TraceWriter late(path() / "late", {.identity = 3});
  const std::int64_t far = 4'000'000'000'000'000'000;
  const std::uint16_t id = late.declare("test:late", "integer { size = 32; align = 8; signed = 0; } wide;");
  late.write_raw(0, far, testing::kPing, id, std::string(4, 1));
  late.write_raw(0, far + 10, testing::kPing, id, std::string(4, 1));
  late.write_raw(0, far + 20, testing::kPing, static_cast<std::uint16_t>(id + 77), "");  // an unknown event
  late.finish();
  const std::string trace = path() / "late";
  EXPECT_EQ(read({trace}).exit_code, 1);
  for (const char* format : {"text", "json", "csv"}) {
    const std::size_t header = format == std::string("csv") ? 1 : 0;
    const CommandResult limited = read({trace, "--limit", "1", "--format", format});
    EXPECT_EQ(limited.exit_code, 0) << limited.err;
    EXPECT_EQ(lines(limited.out), header + 1);
    const CommandResult nothing = read({trace, "--limit", "0", "--format", format});
    EXPECT_EQ(nothing.exit_code, 0) << nothing.err;
    EXPECT_EQ(lines(nothing.out), header);
    const CommandResult until = read({trace, "--to", "+0.00000001", "--format", format});
    EXPECT_EQ(until.exit_code, 0) << until.err;
    EXPECT_EQ(lines(until.out), header + 1);
  }
  EXPECT_EQ(read({trace, "--count", "--to", "+0.00000001"}).out, "    1 test:late\n    1 in all\n");
  EXPECT_EQ(read({"/nonexistent", "--limit", "0"}).exit_code, 1);
}

TEST_F(LaunchTraceRead, CsvHasTheColumnsOfItsEvents) {
  const CommandResult result = read({path(), "--format", "csv", "--event", "ros2:callback_*"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("time_ns,event,cpu_id,vpid,vtid,procname,callback,is_intra_process\n"));
  EXPECT_EQ(lines(result.out), 7u);
}

TEST_F(LaunchTraceRead, MergesSeveralDirectories) {
  testing::TraceWriter other(path() / "other", {.identity = 2});
  other.write(0, 5, testing::kPing, ros2::RclTake{1});
  other.finish();
  const CommandResult result = read({path() / "trace", path() / "other", "--limit", "1"});
  EXPECT_THAT(result.out, StartsWith("1970-01-01 00:00:00.000000005 +0.000000000 ros2:rcl_take"));
}

TEST_F(LaunchTraceRead, RefusesWrongArguments) {
  const CommandResult expression = read({path(), "--where", "topic_name = 'x'"});
  EXPECT_EQ(expression.exit_code, 2);
  EXPECT_THAT(expression.err, StartsWith("launch trace read: error: --where: expected '==' to compare\n"
                                         "    topic_name = 'x'\n"
                                         "               ^\n"));
  const CommandResult time = read({path(), "--from", "noon"});
  EXPECT_EQ(time.exit_code, 2);
  EXPECT_THAT(time.err, StartsWith("launch trace read: error: --from: 'noon' is no time; write seconds since the "
                                   "epoch, 2026-01-31T12:00:00.5 or "
                                   "+SECONDS after the first event of the trace\n"));
  const CommandResult empty = read({path(), "--from", "+5", "--to", "+2"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_EQ(empty.err,
            "launch trace read: error: --to: '+2' is not after --from '+5'\n"
            "      = help: see 'launch trace read --help'\n");
  EXPECT_EQ(read({path(), "--from", "+2", "--to", "+2"}).exit_code, 2);
  const CommandResult limit = read({path(), "--limit", "-1"});
  EXPECT_EQ(limit.exit_code, 2);
  EXPECT_EQ(limit.err,
            "launch trace read: error: --limit: '-1' is below 0\n"
            "      = help: see 'launch trace read --help'\n");
  EXPECT_EQ(read({path(), "--format", "xml"}).exit_code, 2);
  EXPECT_EQ(read({}).exit_code, 2);
}

TEST_F(LaunchTraceRead, SaysWhatIsNoTrace) {
  const CommandResult result = read({"/nonexistent"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch trace read: error: cannot read the trace '/nonexistent': no such directory\n"
            "      = help: give the directory that the launcher printed when it ended the session\n");
}

TEST_F(LaunchTraceRead, SaysThatTheOutputCannotBeWritten) {
  const std::string command = "'" LAUNCH_TRACE_READ "' '" + path().string() + "' ";
  for (const char* option : {"--count", "--format=text", "--format=csv"}) {
    const CommandResult full = test_support::run_command({"sh", "-c", command + option + " > /dev/full"});
    EXPECT_EQ(full.exit_code, 1) << option;
    EXPECT_EQ(full.err, "launch trace read: error: cannot write the output: No space left on device\n") << option;
    // The writer starts when the only reader has ended: a shell may hold the other end of a `|` for a moment longer.
    const CommandResult closed = test_support::run_command(
        {.argv = {"sh", "-c",
                  "rm -f out; mkfifo out; : < out & exec 4> out; wait; " + command + option + " >&4; echo $? >&2"},
         .directory = path()});
    EXPECT_EQ(closed.err, "1\n") << option;
    const CommandResult mute = test_support::run_command({"sh", "-c", command + option + " > /dev/full 2>&-"});
    EXPECT_EQ(mute.exit_code, 1) << option;
  }
}

TEST_F(LaunchTraceRead, WritesOnlyUtf8AsJson) {
  testing::TraceWriter writer(path() / "bytes", {.identity = 4});
  const std::uint16_t id = writer.declare("test:text", "string _text;");
  const std::string bytes = "\xc3\xa4 \xed\xa0\x80 \xf4\x90\x80\x80 \xe0\x80\xaf";
  writer.write_raw(0, 1, testing::kPing, id, bytes + '\0');
  writer.finish();
  const std::string wrong = "\xef\xbf\xbd";  // U+FFFD, for each byte
  EXPECT_THAT(read({path() / "bytes", "--format", "json"}).out,
              HasSubstr("\"\xc3\xa4 " + wrong + wrong + wrong + " " + wrong + wrong + wrong + wrong + " " + wrong +
                        wrong + wrong + "\""));
}

TEST_F(LaunchTraceRead, GivesWhatCanBeReadOfADamagedTrace) {
  const std::filesystem::path stream = path() / "trace" / "ros2_1";
  std::filesystem::resize_file(stream, std::filesystem::file_size(stream) - 5);
  const CommandResult result = read({path(), "--count"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("in all\n"));
  EXPECT_THAT(result.err, HasSubstr("ends behind the end of the file"));
}

}  // namespace
}  // namespace tracing
