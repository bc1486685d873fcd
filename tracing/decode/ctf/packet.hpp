// SPDX-License-Identifier: Apache-2.0
// The packets of a stream file.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

// A stream file, of which parts are read. It is not mapped into memory: a mapped file that gets shorter meanwhile, or
// that fails to be read, ends the program with SIGBUS. No descriptor stays open, because a trace may have more files
// than a process may open.
class StreamFile {
 public:
  // Throws std::system_error.
  explicit StreamFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::size_t size() const { return size_; }  // when it was found
  // Reads `count` bytes from `at` on. Throws DamagedPacket when they are not there any more.
  void read(std::uint8_t* to, std::size_t count, std::size_t at) const;

 private:
  std::filesystem::path path_;
  std::size_t size_ = 0;
  dev_t device_ = 0;  // another program may put another file in its place
  ino_t inode_ = 0;
};

// The description of a packet in its header. Bits count from the beginning of the packet, times are values of the
// stream's clock.
struct Packet {
  const StreamFile* file = nullptr;
  std::uint64_t offset = 0;        // where the packet begins in the file, in bytes
  std::uint64_t events_bit = 0;    // where the first event begins
  std::uint64_t content_bits = 0;  // where the last event ends; if the packet is cut, where the file ends
  std::uint64_t size_bits = 0;     // with padding
  bool is_cut = false;             // the file ends before the packet's content does
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
  bool ends_early = false;      // the last packet of the list ends behind the end of the file
  bool is_short = false;        // the file ends within a packet, which may be the last one of the list
  bool is_undescribed = false;  // the metadata do not describe the packet behind the last one of the list
};

// Reads only the first bytes of each packet. A file that gets shorter meanwhile, or that fails to be read, is a problem
// of the list. Stops when `give_up` returns true. Throws std::system_error when the file can't be opened.
PacketList find_packets(const TraceClass& trace, const StreamFile& file, const std::function<bool()>& give_up = {});

}  // namespace tracing::ctf
