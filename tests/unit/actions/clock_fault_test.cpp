// SPDX-License-Identifier: Apache-2.0
// <fault clock="…"> and <clock>: what they ask for, what the seed draws, and their errors.
#include <gmock/gmock.h>

#include <set>

#include "fault_plan.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {
namespace {

using test_support::PlannedFaults;
using testing::ElementsAre;
using testing::EndsWith;

PlannedFaults plan_clock(const std::string& faults, std::uint64_t seed = 1) {
  return test_support::plan_faults(faults, {seed, std::nullopt}, "<clock rate=\"10\"/>");
}

TEST(ClockFault, AClockIsAProcess) {
  const PlannedFaults planned = plan_clock("");
  ASSERT_EQ(planned.plan.processes.size(), 1U);
  EXPECT_THAT(planned.plan.processes[0].argv,
              ElementsAre(EndsWith("/launch-ros-command"), "clock", "--rate=10", "--start=0", "--frequency=100"));
  EXPECT_EQ(planned.plan.processes[0].name, "clock");
  EXPECT_TRUE(is_clock(planned.plan.processes[0]));
}

TEST(ClockFault, SaysWhatHappensToWhichClock) {
  const PlannedFaults planned = plan_clock(R"xml(
    <fault clock="clock" do="stop"/>
    <fault clock="clock" do="stop" for="2"/>
    <fault clock="clock" do="skew" rate="0.5" for="1"/>
    <fault clock="clock" do="jump" by="-2.5"/>
    <fault process="clock" do="stop"/>)xml");
  ASSERT_EQ(planned.error, "");
  std::vector<std::string> texts;
  for (const FaultRequest& fault : planned.faults()) {
    texts.push_back(describe(fault));
  }
  EXPECT_THAT(texts, ElementsAre("stop of clock 'clock'", "stop of clock 'clock' for 2 s",
                                 "skew of clock 'clock' to 0.5 times its rate for 1 s",
                                 "jump of clock 'clock' by -2.5 s", "stop of 'clock'"));
}

TEST(ClockFault, TheSeedDrawsRateAndDistance) {
  std::set<double> distances;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const PlannedFaults planned = plan_clock(R"(<fault clock="clock" do="jump" by="-5..5"/>)", seed);
    const double by = std::get<ClockFault>(planned.faults().at(0).what).by;
    EXPECT_TRUE(planned.faults().at(0).is_random);
    EXPECT_GE(by, -5);
    EXPECT_LE(by, 5);
    distances.insert(by);
  }
  EXPECT_GT(distances.size(), 90U);
  EXPECT_LT(*distances.begin(), -3);
}

TEST(ClockFault, AttributesGoTogether) {
  const auto error_of = [](const std::string& fault) { return plan_clock(fault).error; };
  EXPECT_EQ(error_of(R"(<fault do="skew" rate="2"/>)"),
            "/t.launch.xml:4:2: error: it is not said which clock\n"
            "    4 | <fault do=\"skew\" rate=\"2\"/>\n"
            "      |  ^~~~~\n"
            "      = help: clock=\"clock\": the name of a <clock>");
  EXPECT_EQ(error_of(R"(<fault clock="clock" do="skew"/>)"),
            "/t.launch.xml:4:2: error: it is not said how fast the time is\n"
            "    4 | <fault clock=\"clock\" do=\"skew\"/>\n"
            "      |  ^~~~~\n"
            "      = help: rate=\"0.5\": half as fast");
  EXPECT_EQ(error_of(R"(<fault clock="clock" do="skew" rate="0..2"/>)"),
            "/t.launch.xml:4:38: error: the time can't run at rate 0\n"
            "    4 | <fault clock=\"clock\" do=\"skew\" rate=\"0..2\"/>\n"
            "      |                                      ^~~~\n"
            "      = help: do=\"stop\" lets it stand still");
  EXPECT_EQ(error_of(R"(<fault clock="clock" do="jump" by="far"/>)"),
            "/t.launch.xml:4:36: error: by takes a number, got 'far'\n"
            "    4 | <fault clock=\"clock\" do=\"jump\" by=\"far\"/>\n"
            "      |                                    ^~~\n"
            "      = help: or a range of them, such as 1..5");
  EXPECT_EQ(error_of(R"(<fault clock="clock" do="jump" by="1" for="2"/>)"),
            "/t.launch.xml:4:44: error: for does not go with do=\"jump\": a jump is over at once\n"
            "    4 | <fault clock=\"clock\" do=\"jump\" by=\"1\" for=\"2\"/>\n"
            "      |                                            ^");
  EXPECT_EQ(error_of(R"(<fault clock="clock" process="clock" do="stop"/>)"),
            "/t.launch.xml:4:31: error: either a process or a clock suffers\n"
            "    4 | <fault clock=\"clock\" process=\"clock\" do=\"stop\"/>\n"
            "      |                               ^~~~~");
}

}  // namespace
}  // namespace launch
