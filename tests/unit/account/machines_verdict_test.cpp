// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/machines_verdict.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/sandbox.hpp"
#include "tracing/record/account/nothing_recorded.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

using tracing::MachinePart;

class MachinesVerdictTest : public testing::Test {
 protected:
  void give(const std::string& folder, const std::string& text) {
    std::filesystem::create_directories(sandbox.directory() / folder);
    std::ofstream(sandbox.directory() / folder / "verdict.json") << text;
  }
  bool judge(const std::vector<MachinePart>& parts) {
    const bool complete = tracing::write_machines_verdict(sandbox.directory(), "walk", parts).complete;
    std::ifstream file(sandbox.directory() / "verdict.json");
    written = nlohmann::json::parse(file);
    EXPECT_EQ(written["complete"], complete);
    return complete;
  }

  test_support::Sandbox sandbox;
  nlohmann::json written;
};

TEST_F(MachinesVerdictTest, CompleteIfAllAre) {
  give("local", R"({"complete": true, "discarded_events": 0, "lost_packets": 0})");
  give("arm", R"({"complete": true, "discarded_events": 0, "lost_packets": 0})");
  EXPECT_TRUE(judge({{.machine = "local", .folder = "local"}, {.machine = "arm", .folder = "arm"}}));
  EXPECT_EQ(written["machines"][1]["machine"], "arm");
  give("arm", R"({"complete": false, "discarded_events": 7, "lost_packets": 0})");
  EXPECT_FALSE(judge({{.machine = "local", .folder = "local"}, {.machine = "arm", .folder = "arm"}}));
  EXPECT_EQ(written["machines"][1]["discarded_events"], 7);
}

TEST_F(MachinesVerdictTest, NothingThatAVerdictMaySayMakesItBetter) {
  for (const char* const text : {"", "[]", "{}", "null", R"({"complete": 1})", R"({"complete": "true"})",
                                 R"({"complete": true, "cut_short": true})", R"({"complete": true)", "[[[[[[[["}) {
    give("arm", text);
    EXPECT_FALSE(judge({{.machine = "arm", .folder = "arm"}})) << text;
  }
  EXPECT_FALSE(judge({{.machine = "arm", .folder = "none"}}));
  EXPECT_EQ(written["absent"][0], "the recording of machine 'arm' has no verdict");
}

TEST_F(MachinesVerdictTest, APartThatIsNotHereIsToldAndNotComplete) {
  EXPECT_FALSE(judge({{.machine = "arm", .problem = "it is lost"}, {.machine = "leg", .left_there = "/there"}}));
  EXPECT_EQ(written["absent"], nlohmann::json::array({"it is lost"}));
  EXPECT_EQ(written["machines"][0]["problem"], "it is lost");
  EXPECT_EQ(written["machines"][1]["left_there"], "/there");
  EXPECT_TRUE(judge({{.machine = "arm", .nothing = true}}));
}

TEST_F(MachinesVerdictTest, AProblemMakesAVerdictIncomplete) {
  const std::string file = sandbox.directory() / "arm/verdict.json";
  give("arm", R"({"session": "walk", "complete": true, "absent": ["one"], "discarded_events": 0})");
  tracing::note_problems(sandbox.directory() / "arm", {"two"});
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(file)),
            nlohmann::json::parse(
                R"({"session": "walk", "complete": false, "absent": ["one", "two"], "discarded_events": 0})"));
  give("arm", R"({"complete": true, "absent": 7})");
  tracing::note_problems(sandbox.directory() / "arm", {"two"});
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(file)),
            nlohmann::json::parse(R"({"complete": false, "absent": ["two"]})"));
  EXPECT_THROW(tracing::note_problems(sandbox.directory() / "leg", {"two"}), tracing::TraceError);
}

// As by a guardian, when the session of this machine is no longer there.
TEST_F(MachinesVerdictTest, TheVerdictOfOneMachineDoesNotTakeItsPlace) {
  EXPECT_FALSE(judge({{.machine = "arm", .problem = "the launch has not ended it"}}));
  tracing::write_verdict({}, "walk", sandbox.directory());
  std::ifstream file(sandbox.directory() / "verdict.json");
  EXPECT_EQ(nlohmann::json::parse(file), written);
}

TEST_F(MachinesVerdictTest, WhereNothingWasToBeRecordedNothingIsMissing) {
  using nlohmann::json;
  const auto verdict_with = [](bool complete, const json& absent) {
    return json{{"complete", complete}, {"absent", absent},      {"damage", ""},
                {"cut_short", false},   {"discarded_events", 0}, {"lost_packets", 0}};
  };
  const json absent = json::array({tracing::kNothingRecorded});
  give("local", verdict_with(false, absent).dump());
  EXPECT_FALSE(judge({{.machine = "local", .folder = "local"}}));
  EXPECT_TRUE(judge({{.machine = "local", .folder = "local", .expects_nothing = true}}));
  json expected = verdict_with(true, json::array());
  expected["nothing_to_record"] = true;
  std::ifstream file(sandbox.directory() / "local/verdict.json");
  EXPECT_EQ(json::parse(file), expected);
  const std::vector<std::pair<std::string, json>> faults = {
      {"absent", json::array({tracing::kNothingRecorded, "more"})},
      {"damage", "a file is gone"},
      {"cut_short", true},
      {"discarded_events", 1},
      {"lost_packets", 1}};
  for (const auto& [field, value] : faults) {
    json worse = verdict_with(false, absent);
    worse[field] = value;
    give("local", worse.dump());
    EXPECT_FALSE(judge({{.machine = "local", .folder = "local", .expects_nothing = true}})) << field;
  }
}

}  // namespace
