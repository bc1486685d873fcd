// SPDX-License-Identifier: Apache-2.0
// The packets of a trace that has been written, stream by stream.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tracing {

// The events of one sub-buffer of one processor, as written to the trace.
struct Packet {
  std::uint64_t begin = 0;  // trace clock, ns
  std::uint64_t end = 0;
  std::uint64_t bytes = 0;                            // of events and header, without padding
  std::uint64_t discarded_events = 0;                 // of the stream since its beginning
  std::optional<std::uint64_t> sequence_number = {};  // of the packets of its stream
  bool is_empty = false;                              // no event is in it
};

// What one processor recorded into one channel.
struct Stream {
  std::string domain;                    // "ust" or "kernel"
  std::string channel;                   // "ros2"
  std::string cpu;                       // "0"
  std::optional<std::int64_t> pid = {};  // of the process that owns the buffers, where each process has its own
  // Of its trace, where each process has its own: a process that executes another program has one for each.
  std::string folder = {};
  std::vector<Packet> packets = {};  // in their order
};

// The streams of the recording in `directory`, the path of its session or of a snapshot. A stream is the same through
// all archives that `lttng rotate` made, and through the numbered files of a channel in `channels_in_files`, which
// limits their size. A stream without readable packets is listed, too: on a full disk there may be no more of it.
// Packets that are there in part are left out. When `give_up` returns true, the rest of the packets is left out, too.
std::vector<Stream> read_streams(const std::filesystem::path& directory,
                                 const std::set<std::string>& channels_in_files = {},
                                 const std::function<bool()>& give_up = {});

// When the last packet of each stream ends that all processes of a user share, as LTTng's index files tell: 0 for a
// stream without a packet. Costs little even for a long trace.
std::vector<std::uint64_t> last_times(const std::filesystem::path& directory,
                                      const std::set<std::string>& channels_in_files);

// The UUIDs of the userspace traces in the recording, as their packets have them.
std::set<std::string> trace_uuids(const std::filesystem::path& directory);

// When the first packet of all streams begins; the greatest number when there is none.
std::uint64_t first_time(const std::vector<Stream>& streams);

// Times of a trace, as reports print them.
inline double to_seconds(std::uint64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e9;
}

}  // namespace tracing
