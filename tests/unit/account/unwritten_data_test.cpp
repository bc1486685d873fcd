// SPDX-License-Identifier: Apache-2.0
// The message for a trace whose streams end before its session.
#include "tracing/record/account/unwritten_data.hpp"

#include <gtest/gtest.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace {

using tracing::LossAccount;
using tracing::Stream;

constexpr std::uint64_t kNsPerSecond = 1'000'000'000;

LossAccount account() {
  LossAccount losses;
  losses.channels = {{.domain = "ust", .channel = "ros2"}, {.domain = "kernel", .channel = "kchan"}};
  return losses;
}

// From the first second of the clock on. Processor 1 writes nothing after half a second, processor 2 never writes.
std::vector<Stream> streams() {
  return {
      {.domain = "ust", .channel = "ros2", .cpu = "0", .packets = {{.begin = kNsPerSecond, .end = 4 * kNsPerSecond}}},
      {.domain = "ust",
       .channel = "ros2",
       .cpu = "1",
       .packets = {{.begin = kNsPerSecond, .end = kNsPerSecond * 3 / 2}}},
      {.domain = "ust", .channel = "ros2", .cpu = "2", .packets = {}},
      {.domain = "ust",
       .channel = "ros2",
       .cpu = "0",
       .pid = 7,
       .packets = {{.begin = kNsPerSecond, .end = kNsPerSecond}}},
      {.domain = "kernel", .channel = "kchan", .cpu = "0", .packets = {{.begin = kNsPerSecond, .end = kNsPerSecond}}}};
}

TEST(UnwrittenData, IsWhatComesAfterTheLastPacketOfAStreamThatEndsBeforeTheSession) {
  LossAccount losses = account();
  tracing::find_unwritten(losses, streams(), 4 * kNsPerSecond, false);
  const auto& ranges = losses.channels[0].unwritten;
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].cpu, "1");
  EXPECT_EQ(ranges[0].begin_ns, kNsPerSecond / 2);
  EXPECT_EQ(ranges[0].end_ns, 3 * kNsPerSecond);
  EXPECT_EQ(ranges[1].cpu, "2");
  EXPECT_EQ(ranges[1].begin_ns, 0u);
  EXPECT_TRUE(losses.channels[1].unwritten.empty());
  EXPECT_EQ(tracing::describe_damage(losses, "", "/traces/run"),
            "data could not be written to /traces/run: events after 0.000 s of 3.000 s are missing; make room there, "
            "or choose another base-path");
  EXPECT_EQ(tracing::describe_damage(losses, "the file system of /traces/run is full", "/traces/run"),
            "the file system of /traces/run is full: events after 0.000 s of 3.000 s are missing; make room there, "
            "or choose another base-path");
}

TEST(UnwrittenData, MayBeAllThatThereWas) {
  LossAccount losses = account();
  const std::vector<Stream> empty = {{.domain = "ust", .channel = "ros2", .cpu = "0", .packets = {}}};
  tracing::find_unwritten(losses, empty, 4 * kNsPerSecond, true);
  EXPECT_EQ(losses.channels[0].unwritten.size(), 1u);
  EXPECT_EQ(tracing::describe_damage(losses, "the disk quota for /traces/run is used up", "/traces/run"),
            "the disk quota for /traces/run is used up: no event could be written; make room there, or choose another "
            "base-path");
}

TEST(UnwrittenData, IsNotLookedForWhereTheEndOfTheSessionIsNotKnown) {
  LossAccount paused = account();
  tracing::find_unwritten(paused, streams(), 0, true);
  EXPECT_TRUE(paused.channels[0].unwritten.empty());
  LossAccount hurried = account();
  hurried.cut_short = true;
  tracing::find_unwritten(hurried, streams(), 4 * kNsPerSecond, true);
  EXPECT_TRUE(hurried.channels[0].unwritten.empty());
  EXPECT_EQ(tracing::describe_damage(hurried, "", "/traces/run"), "");
  EXPECT_EQ(tracing::describe_damage(hurried, "the file system of /traces/run is full", "/traces/run"),
            "the file system of /traces/run is full: events are missing, their number is unknown; make room there, or "
            "choose another base-path");
}

TEST(UnwrittenData, BuffersThatWereFullAtTheEndAreNoFailureToWrite) {
  LossAccount losses = account();
  losses.channels[0].discarded_events = 12;
  tracing::find_unwritten(losses, streams(), 4 * kNsPerSecond, false);
  EXPECT_TRUE(losses.channels[0].unwritten.empty());
  tracing::find_unwritten(losses, streams(), 4 * kNsPerSecond, true);
  EXPECT_EQ(losses.channels[0].unwritten.size(), 2u);
}

TEST(UnwrittenData, ASessionThatWasRotatedEndsWithoutLastPackets) {
  LossAccount losses = account();
  std::vector<Stream> rotated = streams();
  for (Stream& stream : rotated) {
    stream.in_archives = true;
  }
  tracing::find_unwritten(losses, rotated, 4 * kSecond, false);
  EXPECT_TRUE(losses.channels[0].unwritten.empty());
}

TEST(UnwrittenData, ADirectoryWithRoomIsLeftAsItIs) {
  const test_support::Sandbox sandbox;
  std::filesystem::create_directories(sandbox.trace_directory());
  EXPECT_EQ(tracing::why_no_room(sandbox.trace_directory()), "");
  EXPECT_TRUE(std::filesystem::is_empty(sandbox.trace_directory()));
}

}  // namespace
