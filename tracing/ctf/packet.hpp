// SPDX-License-Identifier: Apache-2.0
// The packets of a stream file, which is mapped into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracing/ctf/trace_class.hpp"

namespace tracing::ctf {

// A whole file for reading. The kernel reads its pages when they are touched.
class MappedFile {
 public:
  // Throws std::system_error.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::uint8_t* begin() const { return begin_; }
  const std::uint8_t* end() const { return begin_ + size_; }
  std::size_t size() const { return size_; }
  // The bytes from `begin` to `end` are not needed any more.
  void forget(const std::uint8_t* begin, const std::uint8_t* end) const;

 private:
  const std::uint8_t* begin_ = nullptr;
  std::size_t size_ = 0;
};

// The description of a packet in its header. Bits count from the beginning of the packet, times are values of the
// stream's clock.
struct Packet {
  const MappedFile* file = nullptr;
  const std::uint8_t* begin = nullptr;
  std::uint64_t events_bit = 0;    // where the first event begins
  std::uint64_t content_bits = 0;  // where the last event ends; if the packet is cut, where the file ends
  std::uint64_t size_bits = 0;     // with padding
  bool is_cut = false;             // the file ends before the packet does
  std::uint64_t stream_id = 0;
  std::optional<std::uint64_t> stream_instance_id;
  std::optional<std::uint64_t> time_begin;
  std::optional<std::uint64_t> time_end;
  std::optional<std::uint64_t> sequence_number;
  std::optional<std::uint64_t> discarded_events;  // from the start of the stream to the end of the packet
  std::optional<std::int64_t> cpu_id;
};

// All packets of a file, in its order. A packet that can't be understood ends the list; `problem` then gives the
// reason.
struct PacketList {
  std::vector<Packet> packets;
  std::string problem;
};
PacketList find_packets(const TraceClass& trace, const MappedFile& file);

// The same for a caller that needs no events. It reads only the first bytes of each packet and maps nothing: a file
// that gets shorter meanwhile, or that fails to be read, is a problem of the list and no signal. A packet has no `file`
// and no `begin`, and the one that ends behind the end of the file is left out. Stops when `give_up` returns true.
// Throws std::system_error when the file can't be opened.
PacketList find_packet_headers(const TraceClass& trace, const std::filesystem::path& path,
                               const std::function<bool()>& give_up);

}  // namespace tracing::ctf
