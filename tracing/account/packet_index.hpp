// SPDX-License-Identifier: Apache-2.0
// The packets of a recorded trace, from the index files that LTTng's consumer writes beside the streams, or the
// streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

// One sub-buffer's worth of events of one processor, as it was written.
struct Packet {
  std::uint64_t begin = 0;  // trace clock, ns
  std::uint64_t end = 0;
  std::uint64_t bytes = 0;                            // of events and header, without padding
  std::uint64_t discarded_events = 0;                 // of the stream since its beginning
  std::optional<std::uint64_t> sequence_number = {};  // of the packets of its stream
};

// What one processor recorded into one channel.
struct Stream {
  std::string domain;                    // "ust" or "kernel"
  std::string channel;                   // "ros2"
  std::string cpu;                       // "0"
  std::optional<std::int64_t> pid = {};  // of the process that owns the buffers, where each process has its own
  std::vector<Packet> packets;
};

// The streams of the recording in `directory` (the path of its session, or of a snapshot). A file that is no stream
// gives none. Format of an index: struct ctf_packet_index of lttng-tools, big-endian.
std::vector<Stream> read_packet_index(const std::filesystem::path& directory);

// When the first packet of all streams begins; the greatest number when there is none.
std::uint64_t first_time(const std::vector<Stream>& streams);

}  // namespace tracing
