// SPDX-License-Identifier: Apache-2.0
// The message for a trace whose streams end before its session.
#include "tracing/record/account/unwritten_data.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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
  tracing::find_unwritten(losses, streams(), 4 * kNsPerSecond);
  const auto& ranges = losses.channels[0].unwritten;
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].cpu, "1");
  EXPECT_EQ(ranges[0].begin_ns, kNsPerSecond / 2);
  EXPECT_EQ(ranges[0].end_ns, 3 * kNsPerSecond);
  EXPECT_EQ(ranges[1].cpu, "2");
  EXPECT_EQ(ranges[1].begin_ns, 0u);
  EXPECT_TRUE(losses.channels[1].unwritten.empty());
  EXPECT_EQ(tracing::describe_damage(losses, {}),
            "unfinished: a thread did not complete its event, processor 1, since 0.500 s of 3.000 s (channel ros2); "
            "unfinished: a thread did not complete its event, processor 2, since 0.000 s of 3.000 s (channel ros2)");
  EXPECT_EQ(tracing::describe_damage(losses, {.no_room = "the file system of /traces/run is full"}),
            "the file system of /traces/run is full: events after 0.000 s of 3.000 s are missing; make room there, "
            "or choose another base-path");
}

TEST(UnwrittenData, HasTheProcessesForAReasonThatWereKilled) {
  LossAccount losses = account();
  std::vector<Stream> two = streams();
  two.erase(two.begin() + 2);
  tracing::find_unwritten(losses, two, 4 * kNsPerSecond);
  EXPECT_EQ(tracing::describe_damage(losses, {.killed = {"planner [4711]"}}),
            "unfinished: planner [4711] died within an event, processor 1, since 0.500 s of 3.000 s (channel ros2)");
  EXPECT_EQ(tracing::describe_damage(losses, {.killed = {"planner [4711]", "driver [4712]"}}),
            "unfinished: planner [4711] or driver [4712] died within an event, processor 1, since 0.500 s of 3.000 s "
            "(channel ros2)");
  losses.channels[0].unwritten[0].after_losses = true;
  EXPECT_EQ(tracing::describe_damage(losses, {}),
            "unfinished: the buffers were full to the end, processor 1, since 0.500 s of 3.000 s (channel ros2)");
}

TEST(UnwrittenData, KilledIsWhoHasGoneWithoutATimeOfItsEnd) {
  const pid_t gone = fork();
  if (gone == 0) {
    _exit(0);
  }
  waitpid(gone, nullptr, 0);
  const std::vector<tracing::EventCounts> counts = {
      {.pid = getpid(), .process = "runs"},
      {.pid = gone, .process = "ended", .end = 5},
      {.pid = gone, .process = "killed"},
  };
  EXPECT_EQ(tracing::killed_processes(counts), std::vector<std::string>{"killed [" + std::to_string(gone) + "]"});
}

TEST(UnwrittenData, OfAProcessWithBuffersOfItsOwnIsWhatItsOtherStreamsHave) {
  std::vector<Stream> of_a_process = {
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 7, .packets = {{.begin = 0, .end = 3 * kNsPerSecond}}},
      {.domain = "ust", .channel = "ros2", .cpu = "1", .pid = 7, .packets = {{.begin = 0, .end = kNsPerSecond}}},
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 8, .packets = {{.begin = 0, .end = kNsPerSecond}}}};
  const auto found = tracing::unfinished_streams(of_a_process, 9 * kNsPerSecond);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].cpu, "1");
  EXPECT_EQ(tracing::describe_unfinished(found, {"planner [7]", "driver [9]"}),
            "unfinished: planner [7] died within an event, processor 1, since 1.000 s of 3.000 s (channel ros2)");
  EXPECT_EQ(tracing::describe_unfinished(found, {}),
            "unfinished: process 7 died within an event, processor 1, since 1.000 s of 3.000 s (channel ros2)");
  of_a_process[1].packets[0].discarded_events = 3;
  const auto after_losses = tracing::unfinished_streams(of_a_process, 9 * kNsPerSecond);
  EXPECT_EQ(tracing::describe_unfinished(after_losses, {}),
            "unfinished: the buffers of process 7 were full to its end, processor 1, since 1.000 s of 3.000 s (channel "
            "ros2)");
}

TEST(UnwrittenData, MayBeAllThatThereWas) {
  LossAccount losses = account();
  const std::vector<Stream> empty = {{.domain = "ust", .channel = "ros2", .cpu = "0", .packets = {}}};
  tracing::find_unwritten(losses, empty, 4 * kNsPerSecond);
  EXPECT_EQ(losses.channels[0].unwritten.size(), 1u);
  EXPECT_EQ(tracing::describe_damage(losses, {.no_room = "the disk quota for /traces/run is used up"}),
            "the disk quota for /traces/run is used up: no event could be written; make room there, or choose another "
            "base-path");
}

TEST(UnwrittenData, OfASessionThatWasPausedIsWhatItsOtherStreamsHave) {
  LossAccount paused = account();
  tracing::find_unwritten(paused, streams(), 0);
  ASSERT_EQ(paused.channels[0].unwritten.size(), 2u);
  EXPECT_EQ(paused.channels[0].unwritten[0].cpu, "1");
  EXPECT_TRUE(tracing::unfinished_streams({}, 0).empty());
}

TEST(UnwrittenData, IsNotLookedForInAHurry) {
  LossAccount hurried = account();
  hurried.cut_short = true;
  tracing::find_unwritten(hurried, streams(), 4 * kNsPerSecond);
  EXPECT_TRUE(hurried.channels[0].unwritten.empty());
  EXPECT_EQ(tracing::describe_damage(hurried, {}), "");
  EXPECT_EQ(tracing::describe_damage(hurried, {.no_room = "the file system of /traces/run is full"}),
            "the file system of /traces/run is full: events are missing, their number is unknown; make room there, or "
            "choose another base-path");
}

TEST(UnwrittenData, ADirectoryWithRoomIsLeftAsItIs) {
  const test_support::Sandbox sandbox;
  std::filesystem::create_directories(sandbox.trace_directory());
  EXPECT_EQ(tracing::why_no_room(sandbox.trace_directory()), "");
  EXPECT_TRUE(std::filesystem::is_empty(sandbox.trace_directory()));
}

}  // namespace
