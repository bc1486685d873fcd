// SPDX-License-Identifier: Apache-2.0
// Losses that the packets of a recording tell, and what becomes of the session daemon's counts.
#include "tracing/record/account/packet_losses.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace {

using tracing::BeforeFirstPacket;
using tracing::ChannelLoss;
using tracing::LossAccount;
using tracing::LossSource;
using tracing::PacketLosses;
using tracing::Stream;

Stream stream(std::vector<tracing::Packet> packets, std::optional<std::int64_t> pid = {}) {
  return {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = pid, .packets = std::move(packets)};
}

tracing::Packet packet(std::uint64_t number, std::uint64_t discarded) {
  return {.discarded_events = discarded, .sequence_number = number};
}

LossAccount account(std::uint64_t events_of_daemon, std::uint64_t packets_of_daemon) {
  LossAccount losses;
  losses.channels = {{.domain = "ust",
                      .channel = "ros2",
                      .discarded_events = events_of_daemon,
                      .lost_packets = packets_of_daemon,
                      .counted_by = LossSource::kDaemon}};
  return losses;
}

TEST(PacketLosses, AreTheStepsOfTotalsAndTheGapsOfNumbers) {
  const PacketLosses losses = losses_of(stream({packet(0, 2), packet(1, 5), packet(4, 5), packet(5, 9)}));
  EXPECT_EQ(losses.discarded_events, 9u);
  EXPECT_EQ(losses.lost_packets, 2u);
  EXPECT_EQ(losses.earlier_packets, 0u);
  EXPECT_EQ(losses.earlier_discarded_events, 0u);
}

// Under overload LTTng now and then writes a packet whose total is 0.
TEST(PacketLosses, AreTheHighestTotalThoughATotalGoesBack) {
  EXPECT_EQ(losses_of(stream({packet(0, 2), packet(1, 50), packet(2, 0), packet(3, 51)})).discarded_events, 51u);
  EXPECT_EQ(losses_of(stream({packet(0, 0), packet(1, 50), packet(2, 0)})).discarded_events, 50u);
  const PacketLosses late = losses_of(stream({packet(7, 100), packet(8, 0), packet(9, 103)}));
  EXPECT_EQ(late.discarded_events, 3u);
  EXPECT_EQ(late.earlier_discarded_events, 100u);
}

TEST(PacketLosses, BeforeTheFirstPacketThatIsThereAreApart) {
  const PacketLosses losses = losses_of(stream({packet(7, 100), packet(8, 103)}));
  EXPECT_EQ(losses.discarded_events, 3u);
  EXPECT_EQ(losses.earlier_packets, 7u);
  EXPECT_EQ(losses.earlier_discarded_events, 100u);
}

TEST(PacketLosses, OfAllProcessesReplaceWhatTheDaemonRemembers) {
  LossAccount losses = account(3, 0);
  count_in_packets(losses, {stream({packet(0, 0), packet(1, 30)}, 12), stream({packet(0, 0), packet(2, 12)}, 13)});
  const ChannelLoss& channel = losses.channels[0];
  EXPECT_EQ(channel.discarded_events, 42u);
  EXPECT_EQ(channel.lost_packets, 1u);
  EXPECT_EQ(channel.only_daemon_events, 0u);
  EXPECT_EQ(channel.counted_by, LossSource::kPackets);
}

TEST(PacketLosses, ThatNeverGotIntoAPacketAreTheDaemons) {
  LossAccount losses = account(50, 4);
  count_in_packets(losses, {stream({packet(0, 0), packet(2, 42)})});
  const ChannelLoss& channel = losses.channels[0];
  EXPECT_EQ(channel.discarded_events, 50u);
  EXPECT_EQ(channel.only_daemon_events, 8u);
  EXPECT_EQ(channel.lost_packets, 4u);
  EXPECT_EQ(channel.only_daemon_packets, 3u);
}

TEST(PacketLosses, WithoutPacketsTheDaemonDecides) {
  LossAccount losses = account(50, 4);
  count_in_packets(losses, {stream({})});
  EXPECT_EQ(losses.channels[0].discarded_events, 50u);
  EXPECT_EQ(losses.channels[0].lost_packets, 4u);
  EXPECT_EQ(losses.channels[0].counted_by, LossSource::kDaemon);
}

TEST(PacketLosses, HaveAReasonBeforeTheFirstPacket) {
  LossAccount in_files = account(0, 3);
  in_files.channels[0].tracefile_count = 2;
  count_in_packets(in_files, {stream({packet(7, 0)})});
  EXPECT_EQ(in_files.channels[0].before_first.why, BeforeFirstPacket::kOverwrittenInFiles);
  EXPECT_EQ(in_files.channels[0].before_first.packets, 7u);
  EXPECT_EQ(in_files.channels[0].lost_packets, 0u) << "they are among the packets that were overwritten";
  EXPECT_FALSE(in_files.complete());
  EXPECT_FALSE(in_files.has_losses());

  LossAccount overwritten = account(0, 0);
  overwritten.channels[0].overwrite = true;
  count_in_packets(overwritten, {stream({packet(7, 0)})});
  EXPECT_EQ(overwritten.channels[0].before_first.why, BeforeFirstPacket::kLost);
  EXPECT_TRUE(overwritten.has_losses());

  LossAccount removed = account(0, 0);
  count_in_packets(removed, {stream({packet(7, 0)})});
  EXPECT_EQ(removed.channels[0].before_first.why, BeforeFirstPacket::kRemoved);
  EXPECT_FALSE(removed.has_losses());
}

}  // namespace
