// SPDX-License-Identifier: Apache-2.0
// Runs the program `launch-report` to compare traces.
#include "tracing/show/report/comparison_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::TraceWriter;

class ComparisonCommand : public ::testing::Test {
 protected:
  static constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;
  static constexpr std::int64_t kPeriod = 10'000'000;
  static constexpr testing::Thread kNode{71, 71, "node"};

  struct Outcome {
    int exit_code;
    std::string out;
    std::string err;
  };

  // A node with a timer, whose callback takes `duration_ns` and a little more. Returns the directory.
  std::string trace(const std::string& name, std::int64_t duration_ns, int calls = 200, bool lossy = false,
                    std::string_view node = "node") const {
    TraceWriter writer(directory_.path() / name);
    const auto write = [&](std::int64_t after, const auto& event) { writer.write(0, kBegin + after, kNode, event); };
    write(0, ros2::RclInit{1, "8.10.1"});
    write(10, ros2::RclNodeInit{2, 3, node, "/"});
    write(20, ros2::RclTimerInit{4, kPeriod});
    write(30, ros2::RclcppTimerCallbackAdded{4, 5});
    write(40, ros2::RclcppTimerLinkNode{4, 2});
    for (int call = 1; call <= calls; ++call) {
      write(call * kPeriod, ros2::CallbackStart{5, false});
      write(call * kPeriod + duration_ns + call * 7919 % 1000, ros2::CallbackEnd{5});
    }
    if (lossy) {
      writer.end_packet(0);
      writer.discard_events(0, 37);
      write((calls + 1) * kPeriod, ros2::RclTake{1});
    }
    writer.finish();
    return (directory_.path() / name).string();
  }

  Outcome run(const std::string& arguments) const {
    const fs::path out = directory_.path() / "out";
    const fs::path err = directory_.path() / "err";
    const std::string command =
        std::string(LAUNCH_REPORT) + " " + arguments + " >" + out.string() + " 2>" + err.string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
  }

  static std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  testing::TemporaryDirectory directory_;
  std::string base_ = (directory_.path() / "base.json").string();
};

TEST_F(ComparisonCommand, SaysWhatHasChanged) {
  const std::string before = trace("before", 200'000);
  const std::string after = trace("after", 2'200'000);
  const Outcome outcome = run("--diff " + before + " " + after);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "Before     " + before + ": 405 events in 2.00 s\nAfter      " + after +
                             R"(: 405 events in 2.00 s
Compared   1 subject in 4 tests
Result     1 subject has changed; with a confidence of 99 % none of them by chance

Callbacks
  /node, timer 10 ms
    duration, p10                    200 us -> 2.20 ms   +2.00 ms  (+2.00 ms to +2.00 ms)
    duration, median                 200 us -> 2.20 ms   +2.00 ms  (+2.00 ms to +2.00 ms)
    duration, p90                    201 us -> 2.20 ms   +2.00 ms  (+2.00 ms to +2.00 ms)
)");
}

TEST_F(ComparisonCommand, SaysThatNothingHasChanged) {
  const std::string before = trace("before", 200'000);
  const Outcome outcome = run("--diff " + before + " " + before + " --fail-on changed,gone,new,overall,incomplete");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("\nResult     no change holds\n"));
}

TEST_F(ComparisonCommand, WritesAPageOfBothRuns) {
  const std::string before = trace("before", 200'000);
  const std::string after = trace("after", 2'200'000);
  const std::string page = directory_.path() / "both.html";
  const Outcome outcome = run("--diff " + before + " " + after + " --html " + page + " --fail-on slower");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              StartsWith(run("--diff " + before + " " + after + " --fail-on slower").out + "\n" + page + ": "))
      << "the same, read once for both";
  EXPECT_THAT(content(page), HasSubstr("id=\"facts-before\">{\"version\":1,\"directory\":\"" + before + "\""));
  EXPECT_THAT(content(page), HasSubstr("id=\"comparison\">{\"version\":1,\"before\":{\"source\":\"" + before + "\""));
  run(before + " --save-baseline " + base_);
  const Outcome of_baseline = run("--diff " + base_ + " " + after + " --html " + page);
  EXPECT_EQ(of_baseline.exit_code, 1);
  EXPECT_THAT(of_baseline.err, HasSubstr("--html needs the traces of both runs, and " + base_ + " is no directory"));
}

TEST_F(ComparisonCommand, FailsOnWhatTheUserNames) {
  const std::string both = "--diff " + trace("before", 200'000) + " " + trace("after", 2'200'000);
  const Outcome failed = run(both + " --fail-on slower");
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_THAT(failed.out, ::testing::EndsWith("\nFails on slower\n"));
  EXPECT_EQ(run(both + " --fail-on faster,gone,new,incomplete").exit_code, 0);
  EXPECT_EQ(run(both + " --fail-on faster --fail-on changed").exit_code, 3);
  EXPECT_EQ(run(both + " --fail-on slower --least 3ms").exit_code, 0);
  EXPECT_EQ(run(both + " --fail-on slower --least 50%").exit_code, 3);
}

TEST_F(ComparisonCommand, ComparesWithABaselineOfSeveralRuns) {
  const std::string usual = trace("usual", 200'000);
  const std::string slow = trace("slow", 2'200'000);
  const Outcome saved = run(usual + " --save-baseline " + base_);
  EXPECT_EQ(saved.exit_code, 0) << saved.err;
  EXPECT_THAT(saved.out, StartsWith(base_ + ": "));
  EXPECT_THAT(saved.out, ::testing::EndsWith(" kB, 1 run\n"));
  EXPECT_LT(fs::file_size(base_), 10'000u);
  EXPECT_EQ(run(slow + " --baseline " + base_ + " --fail-on slower").exit_code, 3);
  EXPECT_EQ(run(usual + " --baseline " + base_ + " --fail-on changed").exit_code, 0);

  EXPECT_THAT(run(slow + " --save-baseline " + base_ + " --append").out, ::testing::EndsWith(" kB, 2 runs\n"));
  const Outcome with_both = run(slow + " --baseline " + base_ + " --fail-on slower");
  EXPECT_EQ(with_both.exit_code, 0) << "one of the runs was as slow";
  EXPECT_THAT(with_both.out, StartsWith("Before     " + base_ + ": 2 runs\n"));
  EXPECT_EQ(run("--diff " + base_ + " " + base_).exit_code, 0) << "baselines can be compared with each other";
}

TEST_F(ComparisonCommand, MarksWhatIsIncomplete) {
  const std::string before = trace("before", 200'000);
  const std::string after = trace("after", 2'200'000, 200, true);
  const Outcome outcome = run("--diff " + before + " " + after + " --fail-on incomplete");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("\nAfter      " + after + ": 406 events in 2.01 s, 37 events lost\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n           * events may be missing, so that the figures may be wrong\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n    duration, median *               200 us -> 2.20 ms "));
}

TEST_F(ComparisonCommand, PrintsJson) {
  const Outcome outcome =
      run("--json --fail-on slower --diff " + trace("before", 200'000) + " " + trace("after", 2'200'000, 300));
  EXPECT_EQ(outcome.exit_code, 3);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["compared"], 1);
  EXPECT_EQ(json["changes"].size(), 3u);
  EXPECT_EQ(json["likely"].size(), 0u);
  EXPECT_EQ(json["changes"][0]["subject"], "/node, timer 10 ms");
  EXPECT_EQ(json["changes"][0]["statistic"], "p10");
  EXPECT_NEAR(json["changes"][0]["shift_ns"], 2e6, 1e3);
  EXPECT_EQ(json["failed_on"], nlohmann::json({"slower"}));
}

TEST_F(ComparisonCommand, NeedsSomethingInCommon) {
  const std::string before = trace("before", 200'000);
  const std::string other = trace("other", 200'000, 200, false, "other");
  const Outcome nothing = run("--diff " + before + " " + other);
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_EQ(nothing.err, "launch report: error: " + before + " and " + other +
                             " have no callback, hop, chain or service in common\n");
  const std::string rare = trace("rare", 200'000, 15);
  const Outcome few = run("--diff " + before + " " + rare);
  EXPECT_EQ(few.exit_code, 1);
  EXPECT_EQ(few.err, "launch report: error: " + before + " and " + rare +
                         " have too few samples to compare anything: a callback or message must occur 16 times in "
                         "each run\n");
  const std::string silent = trace("silent", 200'000, 0);
  EXPECT_EQ(
      run(silent + " --save-baseline " + base_).err,
      "launch report: error: " + silent + " has no callback, message or call of a service, so it can't be compared\n");
  EXPECT_FALSE(fs::exists(base_));
}

TEST_F(ComparisonCommand, SaysWhyABaselineCantBeUsed) {
  const std::string usual = trace("usual", 200'000);
  const auto error_with = [&](const std::string& text) {
    std::ofstream(base_) << text;
    const Outcome outcome = run(usual + " --baseline " + base_);
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  };
  EXPECT_EQ(
      error_with(R"({"format": "launch report baseline", "version": 9, "runs": []})"),
      "launch report: error: " + base_ + " has version 9 of the format of baselines, this program reads version 1\n");
  EXPECT_EQ(error_with("# Notes\n"), "launch report: error: " + base_ + " is no baseline of launch report\n");
  // What is no baseline is not replaced by one run more.
  EXPECT_EQ(run(usual + " --save-baseline " + base_ + " --append").exit_code, 1);
  EXPECT_EQ(content(base_), "# Notes\n");
  fs::remove(base_);
  EXPECT_EQ(run(usual + " --baseline " + base_).err,
            "launch report: error: cannot read the baseline " + base_ + ": No such file or directory\n");
}

TEST_F(ComparisonCommand, SaysWhatASideCouldBe) {
  const std::string usual = trace("usual", 200'000);
  const std::string missing = directory_.path() / "missing";
  const std::string error = "launch report: error: " + missing +
                            " does not exist: --diff takes the directory of a trace or the file of a baseline on each "
                            "side\n";
  for (const std::string& sides : {usual + " " + missing, missing + " " + usual}) {
    const Outcome outcome = run("--diff " + sides);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, error);
  }
}

TEST_F(ComparisonCommand, ChecksItsOptions) {
  const std::string usual = trace("usual", 200'000);
  const auto usage_error = [&](const std::string& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
    const std::string prefix = "launch report: error: ";
    EXPECT_EQ(line.substr(0, prefix.size()), prefix);
    return line.substr(std::min(line.size(), prefix.size()));
  };
  EXPECT_EQ(usage_error(usual + " --fail-on slower"), "--fail-on: 'slower' goes with --diff or --baseline");
  EXPECT_EQ(usage_error(usual + " --append"), "--append: goes with --save-baseline");
  EXPECT_EQ(usage_error(usual + " --diff " + usual + " " + usual),
            "--diff: takes both traces itself; no other directory goes with it");
  EXPECT_EQ(usage_error("--diff " + usual + " " + usual + " --least 3z"),
            "--least: '3z' is no change; write a part such as 5% or a time such as 20us");
  EXPECT_EQ(usage_error("--diff " + usual + " " + usual + " --confidence 40%"),
            "--confidence: '40%' is no confidence; write a part above 50% and below 100%");
  EXPECT_EQ(usage_error("--diff " + usual + " " + usual + " --fail-on slow"),
            "--fail-on slow is unknown, expected slower, faster, changed, overall, gone, new, incomplete");
  EXPECT_EQ(usage_error("--diff " + usual + " " + usual + " --csv " + base_),
            "--csv: does not go with --diff or --baseline");
  EXPECT_EQ(usage_error(usual + " --baseline " + base_ + " --html " + base_),
            "--html: goes with --diff; a baseline has nothing to show");
  EXPECT_EQ(usage_error("--diff " + usual + " " + usual + " --html " + base_ + " --from +1"),
            "--from: does not go with --diff or --baseline");
  EXPECT_EQ(usage_error("--summary"), "directory is required");
}

TEST(ComparisonOptions, AreSharesAndTimes) {
  compare::CompareOptions options;
  EXPECT_TRUE(set_least(options, "7.5%"));
  EXPECT_DOUBLE_EQ(options.least_ratio, 0.075);
  EXPECT_TRUE(set_least(options, "1.5 ms"));
  EXPECT_EQ(options.least_ns, 1'500'000);
  EXPECT_TRUE(set_least(options, "0s"));
  EXPECT_EQ(options.least_ns, 0);
  for (const char* text : {"", "5", "%", "-1%", "1h", "nan%", "us"}) {
    EXPECT_FALSE(set_least(options, text)) << text;
  }
  EXPECT_EQ(confidence_of("95%"), 0.95);
  EXPECT_EQ(confidence_of("0.999"), 0.999);
  for (const char* text : {"", "1", "100%", "0.5", "95", "x", "0.9s"}) {
    EXPECT_FALSE(confidence_of(text)) << text;
  }
}

}  // namespace
}  // namespace tracing
