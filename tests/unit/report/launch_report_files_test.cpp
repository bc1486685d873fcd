// SPDX-License-Identifier: Apache-2.0
// The files that the program `launch-report` writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/unit/report/launch_report_case.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::TraceWriter;
using LaunchReportFiles = LaunchReport;

TEST_F(LaunchReportFiles, WritesFilesInsteadOfAReport) {
  TraceWriter writer(directory_.path() / "trace");
  write_ping_pong(writer);
  writer.finish();
  const std::string out = path_ + "/out";
  fs::create_directory(out);
  const Outcome outcome =
      launch_report(path_ + "/trace --html " + out + "/a.html --perfetto " + out + "/a.json --csv " + out +
                    "/csv --sql " + out + "/a.db --dot " + out + "/a.dot --analysis-model " + out + "/model");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              ::testing::MatchesRegex(out + "/a.html: [0-9.]+ kB\n" + out + "/a.json: [0-9.]+ kB\n" + out + "/csv\n" +
                                      out + "/a.db: [0-9.]+ kB\n" + out + "/a.dot: [0-9]+ bytes\n" + out + "/model\n"));
  EXPECT_THAT(content(out + "/a.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_EQ(nlohmann::json::parse(content(out + "/a.json"))["otherData"]["begin_ns"], testing::kPingPongBegin);
  EXPECT_THAT(content(out + "/csv/nodes.csv"), ::testing::EndsWith("/ping\n1,1,/pong\n"));
  EXPECT_THAT(content(out + "/a.db"), StartsWith("SQLite format 3"));
  EXPECT_THAT(content(out + "/a.dot"), HasSubstr("digraph system"));
  EXPECT_THAT(content(out + "/model/callback_instances.csv"), HasSubstr(",80000,False,72\n"));
}

TEST_F(LaunchReportFiles, WritesAPartOfTheTrace) {
  TraceWriter writer(directory_.path() / "trace");
  write_ping_pong(writer);
  writer.finish();
  const std::string begin = path_ + "/trace --csv " + path_ + "/csv --from +0.50705";
  EXPECT_EQ(launch_report(begin).exit_code, 0);
  EXPECT_THAT(content(path_ + "/csv/callback_instances.csv"),
              ::testing::MatchesRegex("id,[^\n]*\n0,2,1,1767225600507070000,80000,0,\n"
                                      "1,0,0,1767225600507220000,30000,0,0\n"));
  EXPECT_EQ(launch_report(begin + " --to 2026-01-01T00:00:00.5071").exit_code, 0);
  EXPECT_THAT(content(path_ + "/csv/callback_instances.csv"),
              ::testing::EndsWith("\n0,2,1,1767225600507070000,80000,0,\n"));
  EXPECT_EQ(launch_report(path_ + "/trace --analysis-model " + path_ + "/model --from +0.50705 --to +0.5071").out,
            path_ + "/model\n");
  EXPECT_THAT(content(path_ + "/model/callback_instances.csv"),
              ::testing::MatchesRegex("callback_object,[^\n]*\n[0-9]+,1767225600507070000,80000,False,72\n"));
  EXPECT_THAT(launch_report(begin + " --to never").err, HasSubstr("--to: 'never' is no time; write seconds since "));
  EXPECT_THAT(launch_report(path_ + "/trace --from +1").err,
              HasSubstr("--from: goes with the options that write files, such as --html"));
}

// As `launch trace read` counts: the launcher has loaded its file 83 ms before the first event of a node.
TEST_F(LaunchReportFiles, CountsOffsetsFromTheFirstEventOfTheTrace) {
  TraceWriter writer(directory_.path() / "trace");
  const std::uint16_t load = writer.declare("launch:load", "string _file;");
  writer.write_raw(0, testing::kPingPongBegin - 83'000'000, {.vpid = 70, .vtid = 70, .procname = "launch"}, load,
                   std::string("a.launch.xml\0", 13));
  write_ping_pong(writer);
  writer.finish();
  const std::string trace = path_ + "/trace --csv " + path_ + "/csv --analysis-model " + path_ + "/model ";
  EXPECT_EQ(launch_report(trace + "--from +0.59007 --to +0.590071").exit_code, 0);
  EXPECT_THAT(content(path_ + "/csv/callback_instances.csv"),
              ::testing::MatchesRegex("id,[^\n]*\n0,2,1,1767225600507070000,80000,0,\n"));
  EXPECT_THAT(content(path_ + "/model/callback_instances.csv"),
              ::testing::MatchesRegex("callback_object,[^\n]*\n[0-9]+,1767225600507070000,80000,False,72\n"));
  EXPECT_EQ(launch_report(trace + "--from +0.590071").exit_code, 0);
  EXPECT_THAT(content(path_ + "/model/callback_instances.csv"), ::testing::Not(HasSubstr(",1767225600507070000,")));
}

TEST_F(LaunchReportFiles, WritesWhatComesBeforeDamageToFiles) {
  TraceWriter writer(directory_.path() / "trace");
  write_ping_pong(writer);
  writer.write_raw(0, testing::kPingPongBegin + 600'000'000, testing::kPing, 999, "");
  writer.finish();
  const Outcome outcome = launch_report(path_ + "/trace --csv " + path_ + "/csv");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, path_ + "/csv\n");
  EXPECT_THAT(outcome.err,
              StartsWith("launch report: error: the trace '" + path_ + "/trace' is damaged or ends early: "));
  EXPECT_THAT(content(path_ + "/csv/trace.csv"), HasSubstr(",57,0,0,"));
  EXPECT_THAT(content(path_ + "/csv/trace.csv"), HasSubstr("is damaged or ends early: "));
}

TEST_F(LaunchReportFiles, SaysWhichFileCannotBeWritten) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.finish();
  for (const char* option : {"--html", "--perfetto", "--sql", "--dot"}) {
    const Outcome outcome = launch_report(path_ + " " + option + " /nowhere/file");
    EXPECT_EQ(outcome.exit_code, 1) << option;
    EXPECT_EQ(outcome.out, "") << option;
    EXPECT_EQ(outcome.err, "launch report: error: cannot write /nowhere/file: No such file or directory\n") << option;
  }
  EXPECT_EQ(launch_report(path_ + " --html /dev/full").err,
            "launch report: error: cannot write /dev/full: No space left on device\n");
}

// There LTTng aligns numbers to their size, which it does not on amd64.
TEST_F(LaunchReportFiles, ReadsATraceThatWasRecordedOnArm64) {
  const std::string unpack = "tar -C " + path_ + " -xf " GOLDEN "/traces/ping_pong_arm64.tar.xz";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  const Outcome outcome = launch_report(path_ + " --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report.at("events"), 460);
  EXPECT_TRUE(report.at("losses").empty());
  ASSERT_EQ(report.at("chains").size(), 1U);
  EXPECT_EQ(report.at("chains").at(0).at("response").at("count"), 10);
}

}  // namespace
}  // namespace tracing
