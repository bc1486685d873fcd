// SPDX-License-Identifier: Apache-2.0
// The report of a launch is about the processes of that launch.
#include "tracing/show/report/launch_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/report/launch_report_case.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Thread;
using testing::TraceWriter;
using ::testing::UnorderedElementsAre;

constexpr Thread kLauncher{60, 60, "launch"};
constexpr Thread kOtherLauncher{61, 61, "launch"};
constexpr Thread kStranger{90, 90, "stranger"};
constexpr Thread kThreadOfStranger{90, 91, "worker"};

class OfLaunch : public LaunchReport {
 protected:
  // Ping and pong, with a process and a launcher of somebody else beside them.
  void record(const fs::path& directory) const {
    TraceWriter writer(directory / "ust/uid/0/64-bit");
    const std::uint16_t exec = writer.declare("launch:exec", "integer { size = 32; align = 8; signed = 1; } pid;\n");
    const std::string pid("\x47\0\0\0", 4);
    writer.write_raw(2, testing::kPingPongBegin, kLauncher, exec, pid);
    writer.write_raw(2, testing::kPingPongBegin + 1, kOtherLauncher, exec, pid);
    writer.write(2, testing::kPingPongBegin + 2, kThreadOfStranger,
                 ros2::RclNodeInit{.node_handle = 1, .rmw_handle = 2, .node_name = "stranger", .namespace_ = "/"});
    writer.write(2, testing::kPingPongBegin + 3, kStranger, ros2::RclTake{1});
    write_ping_pong(writer);
    writer.finish();
  }
  static void judge(const fs::path& directory, const std::string& processes) {
    std::ofstream(directory / "verdict.json") << R"({"session": "run", "launch_processes": )" << processes << "}";
  }
  nlohmann::json json(const std::string& arguments = "") const {
    const Outcome outcome = launch_report(path_ + " --json " + arguments);
    EXPECT_EQ(outcome.err, "");
    return nlohmann::json::parse(outcome.out);
  }
  static std::vector<std::int64_t> ids(const nlohmann::json& processes) {
    std::vector<std::int64_t> ids;
    for (const nlohmann::json& process : processes) {
      ids.push_back(process["vpid"]);
    }
    return ids;
  }
};

TEST_F(OfLaunch, LeavesOthersOut) {
  record(directory_.path());
  judge(directory_.path(), "[60, 71, 72]");
  EXPECT_THAT(launch_report(path_).out,
              AllOf(HasSubstr("Events     57 of 2 processes\nLeft out   1 process of others: --all\nLosses"),
                    Not(HasSubstr("stranger"))));
  const nlohmann::json report = json();
  EXPECT_EQ(report["others"],
            nlohmann::json::parse(R"([{"vpid": 90, "name": "stranger", "host": "box", "events": 2}])"))
      << "a launcher is no process of a system";
  EXPECT_THAT(ids(report["processes"]), UnorderedElementsAre(71, 72));
  EXPECT_EQ(report["events"], 57);
}

// A program of the launch without tracetools counts nothing, so nothing tells whose it is.
TEST_F(OfLaunch, AProcessWithoutEventsOfRos2Stays) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  const std::uint16_t asked =
      writer.declare("lttng_ust_libc:malloc", "integer { size = 32; align = 8; signed = 0; } size;\n");
  const std::string bytes("\x40\0\0\0", 4);
  writer.write_raw(2, testing::kPingPongBegin, kStranger, asked, bytes);
  write_ping_pong(writer);
  writer.finish();
  judge(directory_.path(), "[71, 72]");
  const nlohmann::json report = json();
  EXPECT_THAT(ids(report["processes"]), ::testing::Contains(90));
  EXPECT_TRUE(report["others"].empty()) << report["others"];
}

TEST_F(OfLaunch, HasEverythingWhenThatIsAskedFor) {
  record(directory_.path());
  judge(directory_.path(), "[60, 71, 72]");
  EXPECT_THAT(launch_report(path_ + " --all").out,
              AllOf(HasSubstr("Events     59 of 3 processes\nLosses"), HasSubstr("stranger")));
  const nlohmann::json report = json("--all");
  EXPECT_THAT(report["others"], ElementsAre());
  EXPECT_THAT(ids(report["processes"]), UnorderedElementsAre(71, 72, 90));
}

TEST_F(OfLaunch, HasEverythingOfARecordingThatNamesNoProcesses) {
  record(directory_.path());
  EXPECT_EQ(json()["events"], 59) << "without a verdict";
  std::ofstream(directory_.path() / "verdict.json") << R"({"session": "run"})";
  EXPECT_EQ(json()["events"], 59) << "of a session that was begun by hand";
}

TEST_F(OfLaunch, KnowsTheVerdictAboveATrace) {
  record(directory_.path());
  judge(directory_.path(), "[60, 71, 72]");
  const Outcome outcome = launch_report(path_ + "/ust/uid/0/64-bit");
  EXPECT_THAT(outcome.out, HasSubstr("Left out   1 process of others: --all\n"));
}

TEST_F(OfLaunch, EachRecordingHasItsOwnProcesses) {
  for (const auto& [name, processes] : {std::pair("a", "[71]"), {"b", "[72, 90]"}}) {
    TraceWriter writer(directory_.path() / name / "ust/uid/0/64-bit", {.identity = static_cast<std::uint8_t>(name[0])});
    write_ping_pong(writer);
    writer.finish();
    judge(directory_.path() / name, processes);
  }
  const nlohmann::json report = json();
  EXPECT_THAT(ids(report["processes"]), UnorderedElementsAre(71, 72));
  EXPECT_THAT(ids(report["others"]), UnorderedElementsAre(71, 72));
}

TEST_F(OfLaunch, FilesAndComparisonsLeaveOthersOut) {
  record(directory_.path());
  judge(directory_.path(), "[60, 71, 72]");
  const auto events_in = [&](const std::string& options) {
    const fs::path csv = directory_.path() / "csv";
    fs::remove_all(csv);
    const Outcome outcome =
        launch_report(path_ + options + " --csv " + csv.string() + " --html " + path_ + "/report.html");
    const std::string trace = content(csv / "trace.csv");
    return std::pair(outcome.err, trace.substr(trace.find('\n') + 1 + path_.size()));
  };
  const auto [note, row] = events_in("");
  EXPECT_EQ(note, "launch report: note: 1 process of others: --all\n");
  EXPECT_THAT(row, AllOf(HasSubstr(",57,"), HasSubstr(",1\n")));
  const std::string page = content(directory_.path() / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("\"others\":1"), Not(HasSubstr("\"stranger\""))));
  const auto [no_note, whole] = events_in(" --all");
  EXPECT_EQ(no_note, "");
  EXPECT_THAT(whole, AllOf(HasSubstr(",59,"), HasSubstr(",0\n")));
  EXPECT_THAT(content(directory_.path() / "report.html"), HasSubstr("\"stranger\""));

  const std::string baseline = path_ + "/base.json";
  EXPECT_EQ(launch_report(path_ + " --save-baseline " + baseline).exit_code, 0);
  EXPECT_THAT(content(baseline), Not(HasSubstr("stranger")));
}

TEST(OthersPhrase, CountsThem) {
  EXPECT_EQ(others_phrase({}), "");
  EXPECT_EQ(others_phrase({{}, {}, {}}), "3 processes of others: --all");
}

}  // namespace
}  // namespace tracing
