// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/packet_losses.hpp"

#include <algorithm>

namespace tracing {
namespace {

std::uint64_t beyond(std::uint64_t count, std::uint64_t known) {
  return count > known ? count - known : 0;
}

BeforeFirstPacket::Why reason_of(const ChannelLoss& channel) {
  if (channel.tracefile_count != 0) {
    return BeforeFirstPacket::kOverwrittenInFiles;
  }
  // Buffers that discard the newest events lose no packet.
  return channel.overwrite ? BeforeFirstPacket::kLost : BeforeFirstPacket::kRemoved;
}

void count_channel(ChannelLoss& channel, const std::vector<Stream>& streams) {
  PacketLosses sum;
  bool found = false;
  for (const Stream& stream : streams) {
    if (stream.domain != channel.domain || stream.channel != channel.channel || stream.packets.empty()) {
      continue;
    }
    found = true;
    const PacketLosses losses = losses_of(stream);
    sum.discarded_events += losses.discarded_events;
    sum.lost_packets += losses.lost_packets;
    sum.earlier_packets += losses.earlier_packets;
    sum.earlier_discarded_events += losses.earlier_discarded_events;
  }
  if (!found) {
    return;
  }
  channel.before_first = {
      .why = reason_of(channel), .packets = sum.earlier_packets, .discarded_events = sum.earlier_discarded_events};
  channel.only_daemon_events = beyond(channel.discarded_events, sum.discarded_events + sum.earlier_discarded_events);
  channel.only_daemon_packets = beyond(channel.lost_packets, sum.lost_packets + sum.earlier_packets);
  channel.discarded_events = sum.discarded_events + channel.only_daemon_events;
  channel.lost_packets = sum.lost_packets + channel.only_daemon_packets;
  channel.counted_by = LossSource::kPackets;
}

}  // namespace

std::uint64_t discarded_in(const Stream& stream) {
  std::uint64_t highest = 0;
  for (const Packet& packet : stream.packets) {
    highest = std::max(highest, packet.discarded_events);
  }
  return highest;
}

std::uint64_t packets_between(const Packet& before, const Packet& after) {
  const bool numbered = before.sequence_number && after.sequence_number;
  return numbered ? beyond(*after.sequence_number, *before.sequence_number + 1) : 0;
}

PacketLosses losses_of(const Stream& stream) {
  PacketLosses losses;
  if (stream.packets.empty()) {
    return losses;
  }
  const Packet& first = stream.packets.front();
  losses.earlier_packets = first.sequence_number.value_or(0);
  losses.earlier_discarded_events = losses.earlier_packets == 0 ? 0 : first.discarded_events;
  losses.discarded_events = discarded_in(stream) - losses.earlier_discarded_events;
  for (std::size_t i = 1; i < stream.packets.size(); ++i) {
    losses.lost_packets += packets_between(stream.packets[i - 1], stream.packets[i]);
  }
  return losses;
}

void count_in_packets(LossAccount& account, const std::vector<Stream>& streams) {
  for (ChannelLoss& channel : account.channels) {
    count_channel(channel, streams);
  }
}

}  // namespace tracing
