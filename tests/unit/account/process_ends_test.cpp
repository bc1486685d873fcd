// SPDX-License-Identifier: Apache-2.0
// Where the streams of processes have to end that have buffers of their own.
#include "tracing/record/account/counters/process_ends.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/sandbox.hpp"
#include "tracing/record/account/unwritten_data.hpp"

namespace {

using tracing::Packet;
using tracing::ProcessEnds;
using tracing::Stream;

constexpr std::uint64_t kMs = 1'000'000;
constexpr std::uint64_t kUs = 1'000;
constexpr std::uint64_t kStopped = 9'000 * kMs;

Packet packet(std::uint64_t end) {
  return {.begin = 1, .end = end};
}

Packet empty_packet(std::uint64_t end) {
  return {.begin = 1, .end = end, .is_empty = true};
}

Stream stream(const char* cpu, std::vector<Packet> packets) {
  return {.domain = "ust", .channel = "ros2", .cpu = cpu, .pid = 7, .packets = std::move(packets)};
}

std::string unfinished(const std::vector<Stream>& streams, const ProcessEnds& lived_until = {},
                       std::uint64_t stopped = kStopped) {
  std::string processors;
  for (const tracing::UnwrittenRange& range : tracing::unfinished_streams(streams, stopped, lived_until)) {
    processors += range.cpu;
  }
  return processors;
}

TEST(ProcessEnds, AStreamIsUnfinishedThatGotNoPacketWhenTheOthersDid) {
  const Stream active = stream("0", {packet(100 * kMs), packet(200 * kMs)});
  EXPECT_EQ(unfinished({active, stream("1", {packet(100 * kMs), empty_packet(260 * kMs)})}), "0");
  EXPECT_EQ(unfinished({active, stream("1", {packet(100 * kMs), packet(260 * kMs)})}), "0");
  EXPECT_EQ(unfinished({active, stream("1", {packet(100 * kMs), empty_packet(200 * kMs + 5 * kUs)})}), "");
}

TEST(ProcessEnds, APacketThatTheSwitchTimerEndedIsNotTheLastOne) {
  const Stream active = stream("1", {packet(190 * kMs), packet(200 * kMs + 3 * kUs), packet(204 * kMs)});
  EXPECT_EQ(unfinished({stream("0", {packet(190 * kMs), packet(200 * kMs)}), active}), "0");
  // The consumer was interrupted while it ended the streams.
  EXPECT_EQ(unfinished({stream("0", {packet(190 * kMs), packet(202 * kMs)}), active}), "");
}

TEST(ProcessEnds, AllStreamsAreUnfinishedIfTheProcessLivedLonger) {
  const std::vector<Stream> streams = {stream("0", {packet(100 * kMs), packet(200 * kMs)}),
                                       stream("1", {packet(100 * kMs), packet(200 * kMs)})};
  EXPECT_EQ(unfinished(streams), "");
  EXPECT_EQ(unfinished(streams, {{7, {199 * kMs}}, {8, {300 * kMs}}}), "");
  EXPECT_EQ(unfinished(streams, {{7, {300 * kMs}}}), "01");
}

TEST(ProcessEnds, AProcessThatDiedALittleLaterMayHaveDiedWithinAnEvent) {
  const std::vector<Stream> streams = {stream("0", {packet(100 * kMs), packet(200 * kMs)}),
                                       stream("1", {packet(100 * kMs), packet(200 * kMs)})};
  const ProcessEnds died = {{7, {.lived_until = 160 * kMs, .may_have_lived_to = 208 * kMs}}};
  const auto found = tracing::unfinished_streams(streams, kStopped, died);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].in_doubt);
  EXPECT_EQ(
      tracing::describe_unfinished({found[0]}, {}),
      "unfinished: process 7 may have died within an event, processor 0, since 0.200 s of 0.208 s (channel ros2)");
  EXPECT_EQ(unfinished(streams, {{7, {.lived_until = 160 * kMs, .may_have_lived_to = 199 * kMs}}}), "");
  const std::vector<Stream> with_end = {streams[0], stream("1", {packet(100 * kMs), empty_packet(200 * kMs)})};
  EXPECT_EQ(unfinished(with_end, died), "");
}

TEST(ProcessEnds, AnEmptyLastPacketIsTheEndWhateverOthersSay) {
  const Stream idle = stream("1", {packet(100 * kMs), empty_packet(200 * kMs)});
  EXPECT_EQ(unfinished({stream("0", {packet(100 * kMs), packet(200 * kMs)}), idle}, {{7, {300 * kMs}}}), "");
  EXPECT_EQ(unfinished({stream("0", {packet(100 * kMs), packet(180 * kMs)}), idle}, {{7, {300 * kMs}}}), "0");
}

TEST(ProcessEnds, AFirstPacketMayBeEmptyWithoutAnEnd) {
  const std::vector<Stream> streams = {stream("0", {packet(200 * kMs)}), stream("1", {empty_packet(200 * kMs)})};
  EXPECT_EQ(unfinished(streams, {{7, {300 * kMs}}}), "01");
}

TEST(ProcessEnds, AProcessThatLivesEndsItsStreamsWithTheSession) {
  const std::vector<Stream> streams = {stream("0", {packet(kStopped + 1)}), stream("1", {packet(kStopped + 40 * kMs)})};
  EXPECT_EQ(unfinished(streams, {{7, {kStopped + 500 * kMs}}}), "");
}

TEST(ProcessEnds, OfAProgramThatExecutesAnotherOneAreNotThoseOfTheOther) {
  std::vector<Stream> streams = {stream("0", {packet(100 * kMs)}), stream("1", {packet(100 * kMs)}),
                                 stream("2", {packet(900 * kMs)}), stream("3", {packet(900 * kMs)})};
  streams[0].folder = streams[1].folder = "pid/bash-7-20261127-100000";
  streams[2].folder = streams[3].folder = "pid/planner-7-20261127-100001";
  EXPECT_EQ(unfinished(streams), "");
  EXPECT_EQ(unfinished(streams, {{7, {899 * kMs}}}), "");
  EXPECT_EQ(unfinished(streams, {{7, {950 * kMs}}}), "23");
}

TEST(ProcessEnds, OfASessionThatWasPausedAreComparedWithOneAnother) {
  const std::vector<Stream> streams = {stream("0", {packet(100 * kMs)}),
                                       stream("1", {packet(100 * kMs), packet(200 * kMs)})};
  EXPECT_EQ(unfinished(streams, {{7, {300 * kMs}}}, 0), "0");
}

TEST(ProcessEnds, AreNotedByTheLaunchAndTheProcessKnowsBetter) {
  const test_support::Sandbox sandbox;
  const std::string counters = sandbox.directory().string();
  tracing::note_process_end("", 7, 1, true);
  tracing::note_process_end(counters, 7, 1'000 * kMs, true);
  tracing::note_process_end(counters, 8, 2'000 * kMs, false);
  tracing::note_process_end(counters, 10, 3'000 * kMs, false);
  const ProcessEnds ends = tracing::read_process_ends(counters, {{.pid = 8, .end = 1'999 * kMs}, {.pid = 9}});
  EXPECT_EQ(ends, (ProcessEnds{{7, {950 * kMs, 998 * kMs}}, {8, {1'999 * kMs}}, {10, {2'950 * kMs}}}));
  EXPECT_TRUE(tracing::read_process_ends("", {}).empty());
}

}  // namespace
