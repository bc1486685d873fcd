// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/baseline_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/trace_writer/temporary_directory.hpp"

namespace tracing::compare {
namespace {

using tracing::testing::TemporaryDirectory;

class BaselineFile : public ::testing::Test {
 protected:
  Runs read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_baseline(file_);
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const BaselineError& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_.path() / "base.json";
};

TEST_F(BaselineFile, KeepsEverything) {
  RunSummary run;
  run.directory = "/traces/a";
  run.begin_ns = 1'767'225'600'000'000'000;
  run.duration_ns = 5'000'000'000;
  run.events = 123;
  run.remark = "37 events lost";
  run.measurements = {{Kind::kCallback, "/node, timer 10 ms", "duration", {}, 1000, {5, 4, -3}, true},
                      {Kind::kChain, "/a (timer) -> /b (/x)", "response", {"/a, timer", "/b, /x"}, 2, {7, 8}, false},
                      {Kind::kHop, "/x to /b", "latency", {}, 1, {9}, false},
                      {Kind::kCall, "/add, asked by /b", "round trip", {}, 1, {10}, false}};
  run.measurements[0].sends = false;
  run.measurements[1].waits = true;
  const Runs baseline = read(baseline_text({run, run}));
  EXPECT_EQ(baseline.source, file_.string());
  ASSERT_EQ(baseline.runs.size(), 2u);
  const RunSummary& same = baseline.runs[1];
  EXPECT_EQ(same.directory, run.directory);
  EXPECT_EQ(same.begin_ns, run.begin_ns);
  EXPECT_EQ(same.duration_ns, run.duration_ns);
  EXPECT_EQ(same.events, run.events);
  EXPECT_EQ(same.remark, run.remark);
  ASSERT_EQ(same.measurements.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(same.measurements[i].kind, run.measurements[i].kind);
    EXPECT_EQ(same.measurements[i].subject, run.measurements[i].subject);
    EXPECT_EQ(same.measurements[i].quantity, run.measurements[i].quantity);
    EXPECT_EQ(same.measurements[i].steps, run.measurements[i].steps);
    EXPECT_EQ(same.measurements[i].count, run.measurements[i].count);
    EXPECT_EQ(same.measurements[i].samples, run.measurements[i].samples);
    EXPECT_EQ(same.measurements[i].doubtful, run.measurements[i].doubtful);
    EXPECT_EQ(same.measurements[i].sends, run.measurements[i].sends);
    EXPECT_EQ(same.measurements[i].waits, run.measurements[i].waits);
  }
}

TEST_F(BaselineFile, IsReadOnlyInItsOwnVersion) {
  EXPECT_EQ(error_of(R"({"format": "launch report baseline", "version": 2, "runs": []})"),
            file_.string() + " has version 2 of the format of baselines, this program reads version 1");
}

TEST_F(BaselineFile, SaysWhyItIsNone) {
  const std::string none = file_.string() + " is no baseline of launch report";
  for (const char* text : {"", "{", "[]", "{}", R"({"format": "another", "version": 1})", R"({"format": 7})"}) {
    EXPECT_EQ(error_of(text), none) << text;
  }
  EXPECT_EQ(error_of(R"({"format": "launch report baseline", "version": 1, "runs": []})"),
            file_.string() + " has no run");
}

TEST_F(BaselineFile, SaysWhatIsDamaged) {
  const std::string whole = baseline_text({{.directory = "/a", .measurements = {{Kind::kHop, "x", "y", {}, 1, {1}}}}});
  const auto changed = [&](const auto& change) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(whole);
    change(json);
    return error_of(json.dump());
  };
  const std::string damaged = file_.string() + " is damaged: ";
  EXPECT_EQ(changed([](auto& json) { json.erase("runs"); }), damaged + "key 'runs' not found");
  EXPECT_EQ(changed([](auto& json) { json["runs"][0]["events"] = "many"; }),
            damaged + "type must be number, but is string");
  EXPECT_EQ(changed([](auto& json) { json["runs"][0]["measurements"][0]["kind"] = "node"; }),
            damaged + "'node' is no kind of subject");
  EXPECT_EQ(changed([](auto& json) { json["runs"][0]["measurements"][0]["samples_ns"].clear(); }),
            damaged + "'x' has no samples");
}

TEST_F(BaselineFile, SaysThatItIsNotThere) {
  try {
    read_baseline(file_);
    FAIL();
  } catch (const BaselineError& error) {
    EXPECT_EQ(error.what(), "cannot read the baseline " + file_.string() + ": No such file or directory");
  }
}

}  // namespace
}  // namespace tracing::compare
