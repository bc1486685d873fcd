// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/reload_lines.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <nlohmann/json.hpp>

namespace launch {
namespace {

using nlohmann::json;

TEST(ReloadLines, TellTheDifferenceWithPlaces) {
  const auto file = std::make_shared<SourceFile>("/a/system.launch.xml", "<launch>\n  <executable/>\n</launch>");
  ReloadReport report{.number = 3};
  report.starts = {{"new", {}, {file, 11, 21}}};
  report.restarts = {{"talker-1", {"command line: 1 -> 2"}, {}}};
  report.stays = 4;
  const json line = json::parse(reload_line(report));
  EXPECT_EQ(line["event"], "reload");
  EXPECT_EQ(line["reload"], 3);
  EXPECT_EQ(line["dry_run"], false);
  EXPECT_EQ(line["starts"],
            json::parse(R"([{"process": "new", "place": {"file": "/a/system.launch.xml", "line": 2, "column": 3}}])"));
  EXPECT_EQ(line["restarts"], json::parse(R"([{"process": "talker-1", "changes": ["command line: 1 -> 2"]}])"));
  EXPECT_EQ(line["ends"], json::array());
  EXPECT_EQ(line["stays"], 4);
}

TEST(ReloadLines, TellWhyNothingHappens) {
  ReloadReport report{.number = 1};
  report.refused = "the launch is ending, it does not reload any more";
  EXPECT_EQ(json::parse(reload_line(report))["refused"], report.refused);
  report.refused.clear();
  report.errors = {{Severity::kError, "no such file", {}, {}}};
  EXPECT_EQ(json::parse(reload_line(report))["errors"], "launch: error: no such file\n");
}

TEST(ReloadLines, TheEndNamesWhatHasFailed) {
  EXPECT_EQ(json::parse(reloaded_line({2, {"a-1 has not started"}}))["failures"], json::array({"a-1 has not started"}));
  EXPECT_EQ(reload_answer_line(7), R"({"version":1,"ok":true,"reload":7})");
}

TEST(ReloadReportTest, TheSummaryNamesFiveOfEachKind) {
  ReloadReport report;
  EXPECT_TRUE(report.changes_nothing());
  report.stays = 1;
  for (const char* const name : {"a", "b", "c", "d", "e", "f"}) {
    report.starts.push_back({name, {}, {}});
  }
  report.ends = {{"z-1", {}, {}}};
  EXPECT_EQ(summary(report), "1 ends (z-1), 6 start (a, b, c, d, e, …), 1 stays as it is");
}

}  // namespace
}  // namespace launch
