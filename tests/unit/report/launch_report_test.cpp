// SPDX-License-Identifier: Apache-2.0
// Runs the program `launch-report` on traces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::TemporaryDirectory;
using testing::TraceWriter;

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
};

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Outcome launch_report(const std::string& arguments) {
  const TemporaryDirectory directory;
  const fs::path out = directory.path() / "out";
  const fs::path err = directory.path() / "err";
  const std::string command = std::string(LAUNCH_REPORT) + " " + arguments + " >" + out.string() + " 2>" + err.string();
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

void write_ping_pong(TraceWriter& writer) {
  for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
    writer.write(thread.vpid == testing::kPing.vpid ? 0 : 1, time, thread, event);
  }
}

class LaunchReport : public ::testing::Test {
 protected:
  TemporaryDirectory directory_;
  std::string path_ = directory_.path().string();
};

TEST_F(LaunchReport, PrintsTheReportOfPingAndPong) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();

  const Outcome outcome = launch_report(path_);

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "Trace      " + path_ +
                             R"(
Recorded   2026-01-01 00:00:00.000000 UTC, for 507 ms
Events     57 of 2 processes
Losses     no events lost

Events by process                              total  ping [71]  pong [72]
  ros2:callback_end                                3          2          1
  ros2:callback_start                              3          2          1
  ros2:rcl_init                                    2          1          1
  ros2:rcl_node_init                               2          1          1
  ros2:rcl_publish                                 2          1          1
  ros2:rcl_publisher_init                          2          1          1
  ros2:rcl_subscription_init                       2          1          1
  ros2:rcl_take                                    2          1          1
  ros2:rcl_timer_init                              1          1          0
  ros2:rclcpp_callback_register                    3          2          1
  ros2:rclcpp_executor_execute                     3          2          1
  ros2:rclcpp_executor_get_next_ready              6          4          2
  ros2:rclcpp_executor_wait_for_work               3          2          1
  ros2:rclcpp_publish                              2          1          1
  ros2:rclcpp_subscription_callback_added          2          1          1
  ros2:rclcpp_subscription_init                    2          1          1
  ros2:rclcpp_take                                 2          1          1
  ros2:rclcpp_timer_callback_added                 1          1          0
  ros2:rclcpp_timer_link_node                      1          1          0
  ros2:rmw_publish                                 3          2          1
  ros2:rmw_publisher_init                          3          2          1
  ros2:rmw_subscription_init                       3          1          2
  ros2:rmw_take                                    4          1          3

Callbacks                              count    mean  stddev     min     p50     p90     p99     max
/ping, ping [71]
  subscription /pong                       1 30.0 us       - 30.0 us 30.0 us 30.0 us 30.0 us 30.0 us
    Ping::?(std::shared_ptr<std_msgs::msg::String>)
  timer 500 ms                             1 60.0 us       - 60.0 us 60.0 us 60.0 us 60.0 us 60.0 us
    Ping::?()
/pong, pong [72]
  subscription /ping                       1 80.0 us       - 80.0 us 80.0 us 80.0 us 80.0 us 80.0 us
    Pong::on_ping(std_msgs::msg::String const&)

Topics                  published received  untaken    mean     min     p50     p90     p99     max
  /ping                         1        1        0  150 us  150 us  150 us  150 us  150 us  150 us
  /pong                         1        1        0  115 us  115 us  115 us  115 us  115 us  115 us
  (times: from rmw_publish to callback_start; untaken: by any subscription in the trace)
)");
}

TEST_F(LaunchReport, SummarisesInOneLine) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.write(0, testing::kPingPongBegin + 600'000'000, testing::kPing, ros2::RclTake{1});
  writer.finish();
  const Outcome outcome = launch_report("--summary " + path_);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "58 events, 2 processes, 12 events lost; doubtful: ping [71], pong [72]\n");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(LaunchReport, GivesStreamsRelativeToTheDirectory) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.write(0, testing::kPingPongBegin + 600'000'000, testing::kPing, ros2::RclTake{1});
  writer.finish();
  for (const std::string& given : {path_, path_ + "/", "$(realpath --relative-to=. " + path_ + ")"}) {
    EXPECT_THAT(launch_report(given).out, HasSubstr("\n  ust/uid/0/64-bit/ros2_0  "));
  }
}

TEST_F(LaunchReport, PrintsJson) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.finish();
  const Outcome outcome = launch_report(path_ + " --json");
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["events"], 57);
  EXPECT_EQ(json["error"], nullptr);
  EXPECT_EQ(json["callbacks"].size(), 3u);
  EXPECT_EQ(json["topics"][0]["latency"]["mean_ns"], 150'000.0);
}

TEST_F(LaunchReport, ReportsWhatComesBeforeDamageAndFails) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  constexpr std::uint16_t kUndeclared = 999;
  writer.write_raw(0, testing::kPingPongBegin + 600'000'000, testing::kPing, kUndeclared, "");
  writer.finish();
  const Outcome outcome = launch_report(path_);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, StartsWith("launch report: error: the trace '" + path_ + "' is damaged or ends early: "));
  EXPECT_THAT(outcome.out, HasSubstr("Damaged    the trace '" + path_ + "' is damaged or ends early: "));
  EXPECT_THAT(outcome.out, HasSubstr("Events     57 of 2 processes\n"));
}

TEST_F(LaunchReport, FailsWithoutATrace) {
  for (const char* option : {"", " --json", " --summary"}) {
    const Outcome outcome = launch_report(path_ + option);
    EXPECT_EQ(outcome.exit_code, 1) << option;
    EXPECT_EQ(outcome.out, "") << option;
    EXPECT_EQ(outcome.err, "launch report: error: '" + path_ +
                               "' is not a trace: neither it nor a directory below it has a file 'metadata'\n"
                               "    = help: LTTng writes no trace when no traced process ran during the session, and "
                               "none before 'snapshot record'\n")
        << option;
  }
}

TEST_F(LaunchReport, RefusesWrongArguments) {
  EXPECT_EQ(launch_report("").exit_code, 2);
  EXPECT_EQ(launch_report("--unknown " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--json --summary " + path_).exit_code, 2);
  EXPECT_EQ(launch_report(path_ + " " + path_).exit_code, 2);
}

TEST_F(LaunchReport, ExplainsItself) {
  const Outcome outcome = launch_report("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("--summary"));
}

TEST_F(LaunchReport, CountsWhatIsRecordedOfEachProcessForTheVerdict) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  const testing::Thread thread{.vpid = 12, .vtid = 12, .procname = "talker"};
  writer.write(0, 1000, thread, ros2::RclNodeInit{1, 2, "talker", "/robot"});
  writer.write(0, 1100, thread, ros2::RclNodeInit{3, 4, "other", "/"});
  writer.write(0, 1200, {.vpid = 13, .vtid = 14, .procname = "x"}, ros2::RclTake{1});
  writer.finish();
  const Outcome outcome = launch_report("--recorded " + path_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            R"({"processes":[{"vpid":12,"nodes":["/other","/robot/talker"],"events":{"ros2:rcl_node_init":2}},)"
            R"({"vpid":13,"nodes":[],"events":{"ros2:rcl_take":1}}]})"
            "\n");
}

}  // namespace
}  // namespace tracing
