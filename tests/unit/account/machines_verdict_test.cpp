// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/machines_verdict.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/sandbox.hpp"
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
    const bool complete = tracing::write_machines_verdict(sandbox.directory(), "walk", parts);
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

}  // namespace
