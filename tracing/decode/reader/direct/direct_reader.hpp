// SPDX-License-Identifier: Apache-2.0
// Reads traces with our own decoder (tracing/decode/ctf). Private to the reader.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tracing/decode/reader/event_counts.hpp"
#include "tracing/decode/reader/recorded_bytes.hpp"
#include "tracing/decode/reader/trace_sink.hpp"

namespace tracing {

class DirectReader {
 public:
  // `traces` are the directories with metadata below `directory`; `open` are those among them that are being written.
  // With `one_clock`, the traces of each session are put on one clock (one_clock.hpp).
  // Throws ctf::UnsupportedTrace when another reader must read them, TraceReadError when no reader can.
  DirectReader(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& traces,
               const std::vector<std::filesystem::path>& open, bool one_clock);
  ~DirectReader();

  // Adds a line to damage().
  void note(const std::string& damage);
  // Before the first item: notes it when the packets have fewer bytes.
  void expect(RecordedBytes recorded) { recorded_ = std::move(recorded); }
  // Gives all items, and throws nothing of its own.
  void read(TraceSink& sink);
  // As in TraceReader.
  TraceItem next();
  std::optional<EventCounts> count();
  void throw_damage() const;
  const std::vector<std::string>& damage() const { return damage_; }
  const std::vector<std::string>& clock_notes() const { return clock_notes_; }
  std::uint64_t content_bytes() const { return content_bytes_; }
  bool lacks_descriptions() const { return lacks_descriptions_; }
  const std::deque<TraceDescription>& traces() const { return descriptions_; }

 private:
  struct Trace;
  struct OpenStream;

  void find_streams();
  void open_streams();
  void open_trace(Trace& trace);
  bool advance_to_earliest();
  void advance(OpenStream& stream);
  void note(const OpenStream& stream, const ctf::DamagedPacket& damage);

  std::filesystem::path directory_;
  std::deque<TraceDescription> descriptions_;
  std::vector<std::unique_ptr<Trace>> traces_;  // as descriptions_
  bool are_found_ = false;
  bool is_begun_ = false;
  std::vector<std::unique_ptr<OpenStream>> streams_;
  OpenStream* earliest_ = nullptr;  // the stream whose item is given
  std::vector<OpenStream*> later_;  // a heap of the others with something left; the first one has the next item
  std::vector<std::string> damage_;
  std::vector<std::string> clock_notes_;
  bool lacks_descriptions_ = false;
  std::uint64_t content_bytes_ = 0;
  RecordedBytes recorded_;
};

}  // namespace tracing
