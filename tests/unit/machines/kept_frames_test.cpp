// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/kept_frames.hpp"

#include <gmock/gmock.h>

#include <string>

namespace {

using namespace launch;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(KeptFrames, AreKeptUntilTheyAreAcknowledged) {
  KeptFrames kept;
  kept.add("one");
  kept.add("three");
  kept.add("x");
  EXPECT_EQ(kept.bytes(), 9U);
  kept.acknowledge(0);
  kept.acknowledge(2);
  EXPECT_THAT(kept.waiting(), ElementsAre("x"));
  EXPECT_EQ(kept.bytes(), 1U);
  kept.acknowledge(2);
  kept.add("y");
  EXPECT_THAT(kept.waiting(), ElementsAre("x", "y"));
  kept.acknowledge(4);
  EXPECT_THAT(kept.waiting(), IsEmpty());
  EXPECT_EQ(kept.bytes(), 0U);
}

TEST(KeptFrames, ANumberThatCannotBeIsRefused) {
  KeptFrames kept;
  EXPECT_THROW(kept.acknowledge(1), WireError);
  kept.add("one");
  kept.add("two");
  EXPECT_THROW(kept.acknowledge(3), WireError);
  EXPECT_THROW(kept.acknowledge(UINT64_MAX), WireError);
  kept.acknowledge(2);
  EXPECT_THROW(kept.acknowledge(1), WireError);  // it would have to come again
}

TEST(KeptFrames, WhatIsAboutTheConnectionItselfHasNoNumber) {
  for (const ToAgent kind : {ToAgent::kPing, ToAgent::kEnd, ToAgent::kResume, ToAgent::kAcknowledge}) {
    EXPECT_FALSE(is_numbered(kind));
  }
  for (const ToAgent kind : {ToAgent::kSetup, ToAgent::kStart, ToAgent::kSuspend, ToAgent::kTraceLeave}) {
    EXPECT_TRUE(is_numbered(kind));
  }
  for (const FromAgent kind :
       {FromAgent::kPong, FromAgent::kRefused, FromAgent::kResumed, FromAgent::kAcknowledge, FromAgent::kGone}) {
    EXPECT_FALSE(is_numbered(kind));
  }
  for (const FromAgent kind : {FromAgent::kHello, FromAgent::kOutput, FromAgent::kTraceFailed}) {
    EXPECT_TRUE(is_numbered(kind));
  }
}

TEST(ReceivedFrames, AreAcknowledgedAtOnceOnlyIfItIsMuch) {
  ReceivedFrames received;
  EXPECT_FALSE(received.is_new());
  received.count(100);
  EXPECT_TRUE(received.is_new());
  EXPECT_FALSE(received.is_much());
  EXPECT_EQ(received.tell(), 1U);
  EXPECT_FALSE(received.is_new());
  received.count(60'000);
  EXPECT_FALSE(received.is_much());
  received.count(60'000);
  EXPECT_TRUE(received.is_much());
  EXPECT_EQ(received.tell(), 3U);
  EXPECT_FALSE(received.is_much());
}

TEST(AgentSetup, HasTheNameOfAConnectionThatIsKept) {
  const AgentSetup setup{.setup = "/opt/setup.bash",
                         .silence_milliseconds = 4000,
                         .name = "arm",
                         .wait_milliseconds = 300'000,
                         .id = "0123456789abcdef",
                         .key = "fedcba9876543210"};
  const AgentSetup got = parse_agent_setup(to_wire(setup));
  EXPECT_EQ(got.wait_milliseconds, 300'000U);
  EXPECT_EQ(got.id, setup.id);
  EXPECT_EQ(got.key, setup.key);
  for (const char* const id : {"../../etc/x", "0123/", "ABC", " ", ""}) {
    EXPECT_THROW(parse_agent_setup(to_wire(AgentSetup{.setup = "", .name = "arm", .id = id, .key = "00"})), WireError)
        << id;
  }
  EXPECT_THROW(
      parse_agent_setup(to_wire(AgentSetup{.setup = "", .name = "arm", .id = std::string(65, '0'), .key = "0"})),
      WireError);
}

TEST(ResumeRequest, IsReadOrRefused) {
  const ResumeRequest got = parse_resume_request(to_wire(ResumeRequest{"0a", "0b", 77}));
  EXPECT_EQ(got.id, "0a");
  EXPECT_EQ(got.key, "0b");
  EXPECT_EQ(got.received, 77U);
  EXPECT_THROW(parse_resume_request(to_wire(ResumeRequest{"", "", 0})), WireError);
  EXPECT_THROW(parse_resume_request(to_wire(ResumeRequest{"../x", "0b", 0})), WireError);
  EXPECT_THROW(parse_resume_request(to_wire(ResumeRequest{"0a", "0b", 0}) + "x"), WireError);
  EXPECT_THROW(parse_resume_request("\0\0"), WireError);
}

}  // namespace
