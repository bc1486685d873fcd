// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/packet_index.hpp"

#include <endian.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0xC1F1DCC1;
constexpr std::size_t kLongestEntry = 4096;  // bytes; later versions may append fields

// The 32-bit words at the beginning of a file, and the 64-bit words at the beginning of each entry.
enum HeaderWord { kMagicWord, kMajorWord, kMinorWord, kEntryLengthWord, kHeaderWords };
enum EntryWord { kOffset, kPacketBits, kContentBits, kBegin, kEnd, kDiscarded, kEntryWords };
// Since version 1.1 of the format: after the stream's id and its instance id.
constexpr std::size_t kSequenceNumberWord = 8;

// The packets that the stream, of so many bytes, holds: on a full file system the last may be there in part.
std::optional<std::vector<Packet>> read_index_file(const fs::path& path, std::uint64_t stream_size) {
  std::ifstream file(path, std::ios::binary);
  std::array<std::uint32_t, kHeaderWords> header{};
  if (!file.read(reinterpret_cast<char*>(header.data()), sizeof header) || be32toh(header[kMagicWord]) != kMagic) {
    return std::nullopt;
  }
  const std::size_t length = be32toh(header[kEntryLengthWord]);
  std::array<std::uint64_t, kEntryWords> words{};
  if (length < sizeof words || length > kLongestEntry) return std::nullopt;

  std::vector<Packet> packets;
  for (std::vector<char> entry(length); file.read(entry.data(), static_cast<std::streamsize>(length));) {
    std::memcpy(words.data(), entry.data(), sizeof words);
    // LTTng gives a packet that it could write only in part an offset below zero.
    const std::uint64_t offset = be64toh(words[kOffset]);
    if (offset > stream_size || be64toh(words[kPacketBits]) / 8 > stream_size - offset) break;
    packets.push_back({.begin = be64toh(words[kBegin]),
                       .end = be64toh(words[kEnd]),
                       .bytes = be64toh(words[kContentBits]) / 8,
                       .discarded_events = be64toh(words[kDiscarded])});
    if (length < (kSequenceNumberWord + 1) * sizeof(std::uint64_t)) continue;
    std::uint64_t number = 0;
    std::memcpy(&number, entry.data() + kSequenceNumberWord * sizeof number, sizeof number);
    packets.back().sequence_number = be64toh(number);
  }
  return packets;
}

// The header and the context that begin each packet of a stream, as LTTng 2.13 lays them out.
struct [[gnu::packed]] PacketStart {
  std::uint32_t magic;
  std::array<std::uint8_t, 16> uuid;
  std::uint32_t stream_id;
  std::uint64_t stream_instance_id;
  std::uint64_t begin;
  std::uint64_t end;
  std::uint64_t content_bits;
  std::uint64_t packet_bits;
  std::uint64_t sequence_number;
  std::uint64_t discarded;
};

// From the stream itself, for snapshots have no index, and on a full file system there is no room for one. A packet
// that is there in part is none. Nothing for another file.
std::optional<std::vector<Packet>> read_stream_file(const fs::path& path) {
  constexpr std::uint32_t kPacketMagic = 0xC1FC1FC1;
  std::error_code unknown;
  const std::uint64_t size = fs::file_size(path, unknown);
  std::vector<Packet> packets;
  if (unknown || size < sizeof(PacketStart)) return packets;
  std::ifstream file(path, std::ios::binary);
  PacketStart start{};
  for (std::uint64_t at = 0;
       file.seekg(static_cast<std::streamoff>(at)) && file.read(reinterpret_cast<char*>(&start), sizeof start);
       at += start.packet_bits / 8) {
    const bool is_packet = start.magic == kPacketMagic && start.packet_bits / 8 >= sizeof start;
    if (!is_packet && at == 0) return std::nullopt;
    if (!is_packet || start.packet_bits / 8 > size - at) break;
    packets.push_back({.begin = start.begin,
                       .end = start.end,
                       .bytes = start.content_bits / 8,
                       .discarded_events = start.discarded,
                       .sequence_number = std::uint64_t{start.sequence_number}});
  }
  return packets;
}

// The packets of a stream file CHANNEL_CPU; nothing for another file.
std::optional<std::vector<Packet>> read_stream(const fs::path& path) {
  if (path.filename() == "metadata" || path.has_extension() || path.parent_path().filename() == "index") {
    return std::nullopt;
  }
  std::error_code unknown;
  const std::uint64_t size = fs::file_size(path, unknown);
  if (auto packets = read_index_file(path.parent_path() / "index" / (path.filename().string() + ".idx"), size)) {
    return packets;
  }
  return read_stream_file(path);
}

// 123 of …/ust/pid/NAME-123-20261121-190000/64-bit/ros2_0.
std::optional<std::int64_t> owner_of(const fs::path& stream) {
  constexpr std::size_t kTimeStamp = std::string_view("-YYYYMMDD-HHMMSS").size();
  for (fs::path part = stream.parent_path(); part.has_relative_path(); part = part.parent_path()) {
    if (part.parent_path().filename() != "pid" || part.parent_path().parent_path().filename() != "ust") continue;
    std::string name = part.filename();
    if (name.size() <= kTimeStamp) return std::nullopt;
    name.resize(name.size() - kTimeStamp);
    std::int64_t pid = 0;
    const char* const digits = name.data() + name.rfind('-') + 1;
    const bool read = std::from_chars(digits, name.data() + name.size(), pid).ec == std::errc();
    return read ? std::optional(pid) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Stream> read_packet_index(const fs::path& directory) {
  std::vector<Stream> streams;
  for (const char* domain : {"ust", "kernel"}) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory / domain, none)) {
      if (!entry.is_regular_file(none)) continue;
      const std::string name = entry.path().filename().string();
      const std::size_t separator = name.rfind('_');
      if (separator == std::string::npos) continue;
      auto packets = read_stream(entry.path());
      if (!packets) continue;
      streams.push_back({.domain = domain,
                         .channel = name.substr(0, separator),
                         .cpu = name.substr(separator + 1),
                         .pid = owner_of(entry.path()),
                         .packets = std::move(*packets)});
    }
  }
  std::sort(streams.begin(), streams.end(), [](const Stream& a, const Stream& b) {
    return std::tie(a.domain, a.channel, a.cpu) < std::tie(b.domain, b.channel, b.cpu);
  });
  return streams;
}

std::uint64_t first_time(const std::vector<Stream>& streams) {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  for (const Stream& stream : streams) {
    if (!stream.packets.empty()) first = std::min(first, stream.packets.front().begin);
  }
  return first;
}

}  // namespace tracing
