// SPDX-License-Identifier: Apache-2.0
// Reads the CTF traces below a directory and gives their events in the order of time.
//
// Several traces below the directory (userspace and kernel, the two halves of a dual session, several snapshots) are
// merged into one sequence. A decoder of our own reads what LTTng writes; libbabeltrace2 reads everything else.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/reader/event_counts.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/decode/reader/trace_sink.hpp"

namespace tracing {

class TraceReader {
 public:
  enum class Decoder {
    kAny,         // our own decoder, or libbabeltrace2 if our own does not know something in the trace
    kDirect,      // our own decoder; TraceReadError if it does not know something
    kBabeltrace,  // libbabeltrace2
  };

  // The times of a session of which several traces were recorded, while the wall clock of the machine was set; and
  // those of several machines, whose clocks a launch has compared.
  enum class Clocks {
    kAsRecorded,  // as babeltrace2 shows them: each trace has the distance from the epoch that LTTng has measured for
                  // it
    kOne,         // all traces of the session have the same, and those of other machines are on the clock of the
                  // launch; with our own decoder
  };

  // Finds the traces. Throws TraceReadError when there is none.
  explicit TraceReader(const std::filesystem::path& directory, Decoder decoder = Decoder::kAny);
  // Several directories, merged as one.
  explicit TraceReader(const std::vector<std::filesystem::path>& directories, Decoder decoder = Decoder::kAny,
                       Clocks clocks = Clocks::kAsRecorded);
  TraceReader(const std::vector<std::filesystem::path>& directories, Clocks clocks)
      : TraceReader(directories, Decoder::kAny, clocks) {}
  ~TraceReader();
  TraceReader(const TraceReader&) = delete;
  TraceReader& operator=(const TraceReader&) = delete;

  // Reads everything; to be called once. Throws TraceReadError on damaged data, after the sink has got all events
  // before the damage. With our own decoder it has also got the events of the other packets and streams.
  void read(TraceSink& sink);

  // Counts all events, which takes a fraction of the time of reading them. To be called instead of read(), or before
  // it. Nullopt: they must be read, because a packet is damaged, or libbabeltrace2 reads the trace. Otherwise
  // throw_damage() throws what read() would throw.
  std::optional<EventCounts> count();

  // The same, item by item. An item is valid until the next call. The end comes even after damage: throw_damage() then
  // throws what read() would throw.
  TraceItem next();
  void throw_damage() const;

  // What Clocks::kOne has changed, a sentence each.
  std::vector<std::string> clock_notes() const;
  // What could not be read so far, a line each. Files that are missing are known before the first item.
  const std::vector<std::string>& damage() const;
  // Directories with files that a program was writing when the reading began. Such a trace ends with the last packet
  // that was complete.
  const std::vector<std::filesystem::path>& open_directories() const;
  // A packet of such a trace, and with it what follows in its file, was left out because the metadata do not describe
  // its events yet. LTTng writes the descriptions when a traced program ends or the session is stopped.
  bool lacks_descriptions() const;
  // The content of all packets, without their padding, as the tracer has counted it. Known when an item was asked for,
  // and not with libbabeltrace2.
  std::optional<std::uint64_t> content_bytes() const;
  // With libbabeltrace2 only the traces that have given an item so far. The addresses stay.
  const std::deque<TraceDescription>& traces() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tracing
