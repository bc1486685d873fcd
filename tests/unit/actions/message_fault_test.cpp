// SPDX-License-Identifier: Apache-2.0
// <fault topic="…">: which messages it asks for, what the seed draws, and its errors.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "fault_plan.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using test_support::plan_faults;
using test_support::PlannedFaults;
using testing::ElementsAre;

const MessageFault& messages(const FaultRequest& fault) {
  return std::get<MessageFault>(fault.what);
}

TEST(MessageFault, SaysWhatHappensToWhichMessages) {
  const PlannedFaults planned = plan_faults(R"xml(
    <fault topic="/scan" do="drop"/>
    <fault topic="/scan" do="drop" occurrence="3" count="3"/>
    <fault topic="/scan" do="duplicate" occurrence="5" process="p"/>
    <fault topic="/scan" do="corrupt" count="all" on="take"/>
    <fault topic="/scan" do="corrupt" count="all" occurrence="4" on="take" process="p" node="/ns/n"/>
    <fault topic="/scan" do="delay" by="0.2" every="4" count="3"/>
    <fault topic="/scan" do="drop" every="4" count="3" occurrence="2"/>
    <fault topic="/scan" do="drop" every="2" for="3" node="n"/>
    <group><push_ros_namespace namespace="left"/><fault topic="scan" do="drop" for="1"/></group>)xml");
  ASSERT_EQ(planned.error, "");
  std::vector<std::string> texts;
  for (const FaultRequest& fault : planned.faults()) {
    texts.push_back(describe(fault));
  }
  EXPECT_THAT(texts, ElementsAre("drop of message 1 on '/scan'", "drop of messages 3 to 5 on '/scan'",
                                 "duplicate of message 5 on '/scan' from 'p'",
                                 "corruption of all messages on '/scan' when taken",
                                 "corruption of all messages on '/scan' from message 4 on when taken by 'p', '/ns/n'",
                                 "delay by 0.2 s of 3 messages on '/scan', 1 of 4",
                                 "drop of 3 messages on '/scan', 1 of 4 from message 2 on",
                                 "drop of 1 of 2 messages on '/scan' from '/n' for 3 s",
                                 "drop of all messages on '/left/scan' for 1 s"));
}

TEST(MessageFault, SaysWhatHappensToRequestsAndResponses) {
  const PlannedFaults planned = plan_faults(R"xml(
    <fault service="/add" do="drop"/>
    <fault service="/add" do="delay" by="0.5" on="response" occurrence="2" count="2" process="p"/>
    <fault service="/add" do="duplicate" count="all" on="request" node="/ns/n" process="p"/>
    <fault service="/add" do="corrupt" on="response" every="3" for="2"/>
    <group><push_ros_namespace namespace="left"/><fault service="add" do="drop" occurrence="2" count="all"/></group>)xml");
  ASSERT_EQ(planned.error, "");
  std::vector<std::string> texts;
  for (const FaultRequest& fault : planned.faults()) {
    texts.push_back(describe(fault));
  }
  EXPECT_THAT(texts, ElementsAre("drop of request 1 of '/add'", "delay by 0.5 s of responses 2 to 3 of '/add' at 'p'",
                                 "duplicate of all requests of '/add' at 'p', '/ns/n'",
                                 "corruption of 1 of 3 responses of '/add' for 2 s",
                                 "drop of all requests of '/left/add' from request 2 on"));
  EXPECT_EQ(messages(planned.faults().at(0)).side, MessageFault::Side::kRequest);
  EXPECT_EQ(messages(planned.faults().at(1)).side, MessageFault::Side::kResponse);
}

// Otherwise a file would have other faults with the same seed than before.
TEST(MessageFault, WhatIsDrawnStaysTheSame) {
  const FaultRequest drawn =
      plan_faults(R"xml(<fault topic="/a" do="drop" on="take" occurrence="1..1000000"/>)xml", 7).faults().at(0);
  EXPECT_EQ(drawn.identity, " 0 /a  true 1..1000000 1..1 1..1 0..0 0..0 0..0 1");
}

TEST(MessageFault, TheSeedDrawsEachNumber) {
  const std::string fault =
      R"xml(<fault topic="/a" do="delay" occurrence="3..9" every="1..2" count="2..4" by="0.1..0.2"/>)xml";
  std::set<std::uint64_t> first;
  std::set<std::uint64_t> every;
  std::set<std::uint64_t> count;
  std::set<std::uint64_t> bytes;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const FaultRequest drawn = plan_faults(fault, seed).faults().at(0);
    EXPECT_TRUE(drawn.is_random);
    first.insert(messages(drawn).first);
    every.insert(messages(drawn).every);
    count.insert(*messages(drawn).count);
    bytes.insert(messages(drawn).seed);
    EXPECT_GE(messages(drawn).by, 100ms);
    EXPECT_LE(messages(drawn).by, 200ms);
  }
  EXPECT_THAT(first, ElementsAre(3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(every, ElementsAre(1, 2));
  EXPECT_THAT(count, ElementsAre(2, 3, 4));
  EXPECT_EQ(bytes.size(), 200U);
}

TEST(MessageFault, DrawsTheSameForTheSameSeedWhateverTheOtherFaultsAre) {
  const std::string a = R"xml(<fault topic="/a" do="drop" occurrence="1..1000000"/>)xml";
  const std::string b = R"xml(<fault topic="/b" do="drop" occurrence="1..1000000"/>)xml";
  const PlannedFaults both = plan_faults(a + b + a, 7);
  const PlannedFaults second = plan_faults(b, 7);
  EXPECT_EQ(messages(both.faults().at(1)).first, messages(second.faults().at(0)).first);
  EXPECT_NE(messages(both.faults().at(0)).first, messages(both.faults().at(1)).first);
  EXPECT_NE(messages(both.faults().at(0)).first, messages(both.faults().at(2)).first);
  EXPECT_FALSE(
      plan_faults(R"xml(<fault topic="/a" do="drop" occurrence="3" count="all"/>)xml").faults().at(0).is_random);
}

TEST(MessageFault, AttributesGoTogether) {
  const auto error_of = [](const std::string& fault) { return plan_faults(fault).error; };
  EXPECT_EQ(error_of(R"(<fault do="drop"/>)"),
            "/t.launch.xml:4:2: error: it is not said whose messages they are\n"
            "    4 | <fault do=\"drop\"/>\n"
            "      |  ^~~~~\n"
            "      = help: topic=\"/scan\" or service=\"/add\", by its name in the ROS graph");
  EXPECT_EQ(error_of(R"(<fault topic="/a" service="/b" do="drop"/>)"),
            "/t.launch.xml:4:28: error: either a topic or a service suffers\n"
            "    4 | <fault topic=\"/a\" service=\"/b\" do=\"drop\"/>\n"
            "      |                            ^~");
  EXPECT_EQ(error_of(R"(<fault service="/a" do="drop" on="take"/>)"),
            "/t.launch.xml:4:35: error: on can be request or response, got 'take'\n"
            "    4 | <fault service=\"/a\" do=\"drop\" on=\"take\"/>\n"
            "      |                                   ^~~~");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" topic="/a"/>)"),
            "/t.launch.xml:4:37: error: topic goes with do=\"drop\", do=\"duplicate\", do=\"corrupt\" and do=\"delay\" "
            "only\n"
            "    4 | <fault process=\"p\" do=\"kill\" topic=\"/a\"/>\n"
            "      |                                     ^~");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="delay"/>)"),
            "/t.launch.xml:4:2: error: it is not said how late the messages are\n"
            "    4 | <fault topic=\"/a\" do=\"delay\"/>\n"
            "      |  ^~~~~\n"
            "      = help: by=\"0.2\": seconds");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="drop" by="1"/>)"),
            "/t.launch.xml:4:33: error: by goes with do=\"delay\" and do=\"jump\" only\n"
            "    4 | <fault topic=\"/a\" do=\"drop\" by=\"1\"/>\n"
            "      |                                 ^");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="drop" count="2" for="1"/>)"),
            "/t.launch.xml:4:44: error: either count or for says how long messages suffer\n"
            "    4 | <fault topic=\"/a\" do=\"drop\" count=\"2\" for=\"1\"/>\n"
            "      |                                            ^");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="drop" on="recieve"/>)"),
            "/t.launch.xml:4:33: error: on can be publish or take, got 'recieve'\n"
            "    4 | <fault topic=\"/a\" do=\"drop\" on=\"recieve\"/>\n"
            "      |                                 ^~~~~~~");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="drop" occurrence="0..3"/>)"),
            "/t.launch.xml:4:41: error: occurrence takes a whole number from 1, got '0'\n"
            "    4 | <fault topic=\"/a\" do=\"drop\" occurrence=\"0..3\"/>\n"
            "      |                                         ^~~~\n"
            "      = help: or a range of them, such as 1..5");
  EXPECT_EQ(error_of(R"(<fault topic="/a" do="drop" count="none"/>)"),
            "/t.launch.xml:4:36: error: count takes a whole number from 1, got 'none'\n"
            "    4 | <fault topic=\"/a\" do=\"drop\" count=\"none\"/>\n"
            "      |                                    ^~~~\n"
            "      = help: or a range of them, such as 1..5");
}

}  // namespace
}  // namespace launch
