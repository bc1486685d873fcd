// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/packet_window.hpp"

#include <algorithm>
#include <cstring>

namespace tracing::ctf {

namespace {

constexpr std::uint64_t kByte = 8;      // bits
constexpr std::uint64_t kBlock = 4096;  // bytes

}  // namespace

void PacketWindow::open(const Packet& packet) {
  packet_ = &packet;
  offset_ = 0;
  at = limit_ = packet.events_bit;
  is_last_ = packet.content_bits == packet.events_bit;
}

void PacketWindow::use(ByteArena& bytes) {
  bytes_ = &bytes;
  if (has_more()) {
    limit_ = at;
    is_last_ = false;
  }
}

void PacketWindow::move(std::size_t size) {
  const std::uint64_t content_bytes = (packet_->content_bits + kByte - 1) / kByte;
  // Alignments count from the beginning of the packet; none is larger than a block.
  const std::uint64_t offset = (offset_ + at / kByte) / kBlock * kBlock;
  const std::uint64_t count = std::min<std::uint64_t>(size, content_bytes - offset);
  // Numbers are read as whole words, also at the end of the window.
  std::uint8_t* const bytes = bytes_->allocate(count + sizeof(std::uint64_t));
  packet_->file->read(bytes, count, packet_->offset + offset);
  std::memset(bytes + count, 0, sizeof(std::uint64_t));
  at -= (offset - offset_) * kByte;
  offset_ = offset;
  is_last_ = offset + count == content_bytes;
  begin_ = bytes;
  end_ = begin_ + count;
  limit_ = is_last_ ? packet_->content_bits - offset * kByte : count * kByte;
}

}  // namespace tracing::ctf
