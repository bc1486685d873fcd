// SPDX-License-Identifier: Apache-2.0
// <fault group="…">: which part of the network it asks for, what the seed draws, and its errors.
#include <gmock/gmock.h>

#include <set>

#include "fault_plan.hpp"

namespace launch {
namespace {

using test_support::plan_faults;
using test_support::PlannedFaults;
using testing::ElementsAre;

TEST(NetworkFault, SaysWhatHappensBetweenWhom) {
  const PlannedFaults planned = plan_faults(R"xml(
    <let name="who" value="lidar"/>
    <fault do="partition" group="camera $(var who)"/>
    <fault do="partition" group="camera" from="planner map" for="2"/>
    <fault do="lose" group="camera" share="0.25"/>
    <fault do="delay" group="camera" from="map" by="0.1"/>)xml");
  ASSERT_EQ(planned.error, "");
  std::vector<std::string> texts;
  for (const FaultRequest& fault : planned.faults()) {
    texts.push_back(describe(fault));
  }
  EXPECT_THAT(texts, ElementsAre("partition of 'camera', 'lidar' from the others",
                                 "partition of 'camera' from 'planner', 'map' for 2 s",
                                 "loss of 25% of the packets between 'camera' and the others",
                                 "delay by 0.1 s of the packets between 'camera' and 'map'"));
  EXPECT_FALSE(planned.faults().at(2).is_random);  // what gets lost is drawn, that something gets lost is not
}

TEST(NetworkFault, TheSeedDrawsShareDelayAndWhatGetsLost) {
  std::set<double> shares;
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const FaultRequest drawn = plan_faults(R"(<fault do="lose" group="a" share="0.1..0.3"/>)", seed).faults().at(0);
    const NetworkFault& fault = std::get<NetworkFault>(drawn.what);
    EXPECT_TRUE(drawn.is_random);
    EXPECT_GE(fault.share, 0.1);
    EXPECT_LE(fault.share, 0.3);
    shares.insert(fault.share);
    seeds.insert(fault.seed);
  }
  EXPECT_GT(shares.size(), 50U);
  EXPECT_EQ(seeds.size(), 100U);
}

TEST(NetworkFault, AttributesGoTogether) {
  const auto error_of = [](const std::string& fault) { return plan_faults(fault).error; };
  EXPECT_EQ(error_of(R"(<fault do="partition"/>)"),
            "/t.launch.xml:4:2: error: it is not said between which processes\n"
            "    4 | <fault do=\"partition\"/>\n"
            "      |  ^~~~~\n"
            "      = help: group=\"camera driver\": these processes and all others, or those of from=\"…\"");
  EXPECT_EQ(error_of(R"(<fault do="lose" group="a"/>)"),
            "/t.launch.xml:4:2: error: it is not said how much gets lost\n"
            "    4 | <fault do=\"lose\" group=\"a\"/>\n"
            "      |  ^~~~~\n"
            "      = help: share=\"0.2\": one packet in five");
  EXPECT_EQ(error_of(R"(<fault do="delay" group="a"/>)"),
            "/t.launch.xml:4:2: error: it is not said how late the packets are\n"
            "    4 | <fault do=\"delay\" group=\"a\"/>\n"
            "      |  ^~~~~\n"
            "      = help: by=\"0.2\": seconds");
  EXPECT_EQ(error_of(R"(<fault do="partition" group="a" process="a"/>)"),
            "/t.launch.xml:4:42: error: process does not go with a fault of the network\n"
            "    4 | <fault do=\"partition\" group=\"a\" process=\"a\"/>\n"
            "      |                                          ^\n"
            "      = help: group and from name the processes");
  EXPECT_EQ(error_of(R"(<fault do="partition" group="a b" from="b"/>)"),
            "/t.launch.xml:4:41: error: 'b' is on both sides\n"
            "    4 | <fault do=\"partition\" group=\"a b\" from=\"b\"/>\n"
            "      |                                         ^");
  EXPECT_EQ(error_of(R"(<fault do="lose" group="a" share="0.5..2"/>)"),
            "/t.launch.xml:4:35: error: a share is at most 1, got 2\n"
            "    4 | <fault do=\"lose\" group=\"a\" share=\"0.5..2\"/>\n"
            "      |                                   ^~~~~~");
}

}  // namespace
}  // namespace launch
