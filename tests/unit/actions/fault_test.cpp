// SPDX-License-Identifier: Apache-2.0
// <fault>: what it asks for, what the seed draws, and its errors.
#include <gmock/gmock.h>

#include "fault_plan.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using test_support::plan_faults;
using test_support::plan_test_file;
using test_support::PlannedFaults;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> texts(const PlannedFaults& planned) {
  std::vector<std::string> all;
  for (const FaultRequest& fault : planned.faults()) {
    all.push_back(describe(fault));
  }
  return all;
}

TEST(Fault, SaysWhatIsDoneToWhichProcess) {
  const PlannedFaults planned = plan_faults(R"xml(
    <fault process="p" do="kill"/>
    <group><fault process="p" do="kill" signal="TERM" at="1.5"/></group>
    <fault process="p" do="stop" if="false"/>
    <fault process="p" do="stop" for="2"/>
    <fault process="p" do="slow" to="25%" for="0.5"/>
    <fault process="p" do="limit" memory="1M" files="20"/>
    <fault process="p" do="limit" files="0"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(texts(planned), ElementsAre("kill of 'p'", "kill of 'p' by SIGTERM", "stop of 'p' for 2 s",
                                          "slow of 'p' to 25% for 0.5 s", "limit of 'p' to 1048576 bytes and 20 files",
                                          "limit of 'p' to 0 files"));
  EXPECT_EQ(planned.faults()[1].at, 1500ms);
  EXPECT_EQ(planned.faults()[5].number, 6U);
}

TEST(Fault, MeansTheSameInYaml) {
  const PlannedFaults planned = plan_test_file(R"(launch:
- executable: {cmd: p}
- test:
    name: t
    output: [{text: a}]
    children:
    - fault:
        process: p
        do: kill
        at: 2
        depends_on:
        - {process: p, condition: output, pattern: ready, occurrence: 3}
)");
  ASSERT_EQ(planned.error, "");
  ASSERT_THAT(planned.faults(), SizeIs(1));
  EXPECT_EQ(planned.faults()[0].at, 2s);
  EXPECT_EQ(describe(planned.faults()[0].dependencies.at(0)), "'p' has written a line that matches 'ready', 3 times");
}

TEST(Fault, TheSeedDrawsWithinTheRange) {
  const std::string fault = R"xml(<fault process="p" do="stop" at="1..5" for="0.1..0.2" probability="0.5">
    <depends_on process="p" condition="output" occurrence="2..4"/></fault>)xml";
  std::set<Duration> times;
  std::map<std::uint64_t, int> occurrences;
  int left_out = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const FaultRequest drawn = plan_faults(fault, {seed, std::nullopt}).faults().at(0);
    EXPECT_TRUE(drawn.is_random);
    EXPECT_GE(drawn.at, 1s);
    EXPECT_LE(drawn.at, 5s);
    EXPECT_GE(*drawn.lasts, 100ms);
    EXPECT_LE(*drawn.lasts, 200ms);
    times.insert(drawn.at);
    ++occurrences[std::get<UntilOutput>(std::get<ProcessCondition>(drawn.dependencies.at(0).condition).state)
                      .occurrence];
    left_out += drawn.left_out == "not drawn" ? 1 : 0;
  }
  EXPECT_GT(times.size(), 800U);
  EXPECT_THAT(occurrences, SizeIs(3));
  for (const auto& [number, count] : occurrences) {
    EXPECT_NEAR(count, 333, 70) << number;
  }
  EXPECT_NEAR(left_out, 500, 70);
}

TEST(Fault, DrawsTheSameForTheSameSeedWhateverTheOtherFaultsAre) {
  const std::string a = R"xml(<fault process="p" do="kill" at="1..5"/>)xml";
  const std::string b = R"xml(<fault process="p" do="stop" for="1" at="1..5"/>)xml";
  const PlannedFaults both = plan_faults(a + b + a, {7, std::nullopt});
  const PlannedFaults second = plan_faults(b, {7, std::nullopt});
  EXPECT_EQ(both.faults().at(1).at, second.faults().at(0).at);
  EXPECT_NE(both.faults().at(0).at, both.faults().at(1).at);
  EXPECT_NE(both.faults().at(0).at, both.faults().at(2).at);  // equal faults are told apart by their order
  EXPECT_NE(second.faults().at(0).at, plan_faults(b, {8, std::nullopt}).faults().at(0).at);
}

TEST(Fault, ANameKeepsTheDrawsWhenAnAttributeChanges) {
  const auto at = [](const std::string& signal) {
    return plan_faults("<fault name=\"end\" process=\"p\" do=\"kill\" signal=\"" + signal + "\" at=\"1..5\"/>")
        .faults()
        .at(0)
        .at;
  };
  EXPECT_EQ(at("SIGTERM"), at("SIGKILL"));
}

TEST(Fault, OnlyTheChosenOnesAreApplied) {
  const std::string fault = R"xml(<fault process="p" do="kill" at="1..5"/>)xml";
  const PlannedFaults all = plan_faults(fault + fault + fault, {7, std::nullopt});
  const PlannedFaults second = plan_faults(fault + fault + fault, {7, std::set<std::size_t>{2}});
  EXPECT_EQ(second.faults().at(0).left_out, "not chosen");
  EXPECT_EQ(second.faults().at(1).left_out, "");
  EXPECT_EQ(second.faults().at(2).left_out, "not chosen");
  EXPECT_EQ(second.faults().at(1).at, all.faults().at(1).at);
}

std::string error_of(const std::string& fault) {
  return plan_faults(fault).error;
}

TEST(Fault, KnowsItsKinds) {
  EXPECT_EQ(error_of(R"(<fault process="p" do="kil"/>)"),
            "/t.launch.xml:4:24: error: do can be kill, stop, slow, limit, drop, duplicate, corrupt, delay, partition, "
            "lose, skew, jump or fill_disk, got 'kil'\n"
            "    4 | <fault process=\"p\" do=\"kil\"/>\n"
            "      |                        ^~~\n"
            "      = help: did you mean 'kill'?");
}

TEST(Fault, EachKindHasItsAttributes) {
  EXPECT_EQ(error_of(R"(<fault process="p" do="stop" signal="SIGTERM"/>)"),
            "/t.launch.xml:4:38: error: signal goes with do=\"kill\" only\n"
            "    4 | <fault process=\"p\" do=\"stop\" signal=\"SIGTERM\"/>\n"
            "      |                                      ^~~~~~~");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" for="3"/>)"),
            "/t.launch.xml:4:35: error: for does not go with do=\"kill\": a kill is over at once\n"
            "    4 | <fault process=\"p\" do=\"kill\" for=\"3\"/>\n"
            "      |                                   ^");
  EXPECT_EQ(error_of(R"(<fault do="kill"/>)"),
            "/t.launch.xml:4:2: error: it is not said which process suffers\n"
            "    4 | <fault do=\"kill\"/>\n"
            "      |  ^~~~~\n"
            "      = help: process=\"…\": the name of the process or of its node");
  EXPECT_EQ(error_of(R"(<fault process="p" do="slow"/>)"),
            "/t.launch.xml:4:2: error: it is not said how slow the process is\n"
            "    4 | <fault process=\"p\" do=\"slow\"/>\n"
            "      |  ^~~~~\n"
            "      = help: to=\"25%\": a quarter of the time");
  EXPECT_EQ(error_of(R"(<fault process="p" do="limit"/>)"),
            "/t.launch.xml:4:2: error: it is not said what is limited\n"
            "    4 | <fault process=\"p\" do=\"limit\"/>\n"
            "      |  ^~~~~\n"
            "      = help: give memory, files or both");
}

TEST(Fault, ValuesMakeSense) {
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" at="5..1"/>)"),
            "/t.launch.xml:4:34: error: the range of at begins behind its end: '5..1'\n"
            "    4 | <fault process=\"p\" do=\"kill\" at=\"5..1\"/>\n"
            "      |                                  ^~~~");
  EXPECT_EQ(error_of(R"(<fault process="p" do="stop" for="1..x"/>)"),
            "/t.launch.xml:4:35: error: for takes a number that is not negative, got 'x'\n"
            "    4 | <fault process=\"p\" do=\"stop\" for=\"1..x\"/>\n"
            "      |                                   ^~~~\n"
            "      = help: or a range of them, such as 1..5");
  EXPECT_EQ(error_of(R"(<fault process="p" do="slow" to="100%"/>)"),
            "/t.launch.xml:4:34: error: '100%' is no part of the processor\n"
            "    4 | <fault process=\"p\" do=\"slow\" to=\"100%\"/>\n"
            "      |                                  ^~~~\n"
            "      = help: write 1% to 99%");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" signal="SIGTREM"/>)"),
            "/t.launch.xml:4:38: error: 'SIGTREM' is no signal\n"
            "    4 | <fault process=\"p\" do=\"kill\" signal=\"SIGTREM\"/>\n"
            "      |                                      ^~~~~~~\n"
            "      = help: did you mean 'SIGTERM'?");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" probability="1.5"/>)"),
            "/t.launch.xml:4:43: error: a probability is at most 1, got 1.5\n"
            "    4 | <fault process=\"p\" do=\"kill\" probability=\"1.5\"/>\n"
            "      |                                           ^~~");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill"><depends_on process="p" occurrence="2"/></fault>)"),
            "/t.launch.xml:4:66: error: occurrence goes with condition=\"output\" only\n"
            "    4 | <fault process=\"p\" do=\"kill\"><depends_on process=\"p\" occurrence=\"2\"/></fault>\n"
            "      |                                                                  ^");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill"><depends_on process="q"/></fault>)"),
            "/t.launch.xml:4:31: error: no process is named 'q'\n"
            "    4 | <fault process=\"p\" do=\"kill\"><depends_on process=\"q\"/></fault>\n"
            "      |                               ^~~~~~~~~~\n"
            "      = help: what a timer or an event handler starts is not known before it does");
}

TEST(Fault, BelongsInATest) {
  EXPECT_EQ(plan_test_file("<launch>\n<fault process=\"p\" do=\"kill\"/></launch>").error,
            "/t.launch.xml:2:2: error: a fault belongs in a <test>\n"
            "    2 | <fault process=\"p\" do=\"kill\"/></launch>\n"
            "      |  ^~~~~\n"
            "      = help: there it may be in groups, loops and included files; at and depends_on say when it happens");
  EXPECT_EQ(error_of(R"(<timer period="1"><fault process="p" do="kill"/></timer>)"),
            "/t.launch.xml:4:20: error: a fault belongs in a <test>\n"
            "    4 | <timer period=\"1\"><fault process=\"p\" do=\"kill\"/></timer>\n"
            "      |                    ^~~~~\n"
            "      = help: there it may be in groups, loops and included files; at and depends_on say when it happens");
}

TEST(Fault, OnlyItsOwnConditionsDraw) {
  EXPECT_EQ(
      error_of(R"(<executable cmd="b"><depends_on process="p" condition="output" occurrence="1..2"/></executable>)"),
      "/t.launch.xml:4:76: error: only the depends_on of a <fault> draws a number of a range\n"
      "    4 | <executable cmd=\"b\"><depends_on process=\"p\" condition=\"output\" "
      "occurrence=\"1..2\"/></executable>\n"
      "      |                                                                            ^~~~\n"
      "      = help: give one number");
}

}  // namespace
}  // namespace launch
