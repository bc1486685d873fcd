// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/direct_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <tuple>

#include "tracing/decode/ctf/streams/read_ahead.hpp"
#include "tracing/decode/ctf/streams/stream_cursor.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/direct/declarations.hpp"
#include "tracing/decode/reader/direct/machine_clock.hpp"
#include "tracing/decode/reader/direct/one_clock.hpp"
#include "tracing/decode/reader/direct/packet_counting.hpp"
#include "tracing/decode/reader/direct/stream_class.hpp"
#include "tracing/decode/reader/direct/stream_files.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

void add_names(const ctf::FieldClassPtr& structure, std::vector<std::string>& names) {
  if (!structure) {
    return;
  }
  for (const ctf::FieldMember& member : structure->members) {
    names.push_back(member.name);
  }
}

Recording recording_of_trace(const ctf::TraceClass& trace) {
  return recording_of({.hostname = trace.environment_text("hostname"),
                       .domain = trace.environment_text("domain"),
                       .trace_name = trace.environment_text("trace_name"),
                       .trace_creation_datetime = trace.environment_text("trace_creation_datetime"),
                       .clock_uuid = trace.clocks.empty() ? std::string() : trace.clocks.begin()->second.uuid,
                       .trace_uuid = trace.uuid});
}

Loss loss_of(const ctf::StreamLoss& loss, const Stream& stream) {
  return {.kind = loss.of_packets ? Loss::Kind::kPackets : Loss::Kind::kEvents,
          .stream = &stream,
          .begin_ns = loss.begin_ns,
          .end_ns = loss.end_ns,
          .count = loss.count};
}

// The path that messages and losses show.
std::string shown_path(const fs::path& file) {
  std::error_code gone;
  const fs::path canonical = fs::canonical(file, gone);
  return gone ? file.string() : canonical.string();
}

}  // namespace

// Directories with the same identity, such as the chunks of a rotated session or several snapshots.
struct DirectReader::Trace {
  ctf::TraceClass declarations;
  Recording recording;
  std::size_t number = 0;
  bool is_open = false;
  std::map<std::uint64_t, std::unique_ptr<StreamClass>> stream_classes;
  std::vector<EventClass> event_classes;  // by the number of the declaration
  std::vector<std::unique_ptr<ctf::StreamFile>> files;
};

struct DirectReader::OpenStream {  // that is being read
  OpenStream(Trace& of, const StreamClass& is, Stream as, std::vector<ctf::Packet> packets)
      : trace(of), stream_class(is), description(std::move(as)), cursor(is.layout(), std::move(packets)) {}

  bool is_later_than(const OpenStream& other) const {
    const std::int64_t mine = cursor.time_ns();
    const std::int64_t its = other.cursor.time_ns();
    return mine != its ? mine > its : index > other.index;
  }
  TraceItem give();

  static constexpr std::size_t kNoPacket = static_cast<std::size_t>(-1);
  Trace& trace;
  const StreamClass& stream_class;
  Stream description;
  ctf::StreamCursor cursor;
  ctf::StreamCursor::Item item = ctf::StreamCursor::Item::kEnd;
  std::size_t index = 0;  // decides the order of equal times

 private:
  Event event_;                     // its records always have the same addresses
  std::size_t packet_ = kNoPacket;  // of the last event
  StreamClass::LastName last_name_;
  Loss loss_;
};

[[gnu::always_inline]] inline TraceItem DirectReader::OpenStream::give() {
  if (item == ctf::StreamCursor::Item::kEvent) {
    event_.event_class = &trace.event_classes[cursor.event().index];
    event_.timestamp_ns = cursor.time_ns();
    if (cursor.packet_number() != packet_) {
      packet_ = cursor.packet_number();
      event_.cpu_id = cursor.packet().cpu_id;
    }
    const ctf::Record& contexts = cursor.stream_context();
    stream_class.read_contexts(contexts, event_, last_name_);
    event_.record = &cursor.payload();
    event_.stream_context = &contexts;
    event_.event_context = &cursor.event_context();
    return {&event_, nullptr};
  }
  loss_ = loss_of(cursor.loss(), description);
  return {nullptr, &loss_};
}

DirectReader::DirectReader(const fs::path& directory, const std::vector<fs::path>& traces,
                           const std::vector<fs::path>& open, bool one_clock)
    : directory_(directory) {
  std::map<std::string, std::size_t> by_identity;
  std::vector<std::size_t> length;  // of the metadata that each trace uses
  for (const fs::path& path : traces) {
    const bool is_open = std::find(open.begin(), open.end(), path) != open.end();
    auto [declarations, size, is_cut] = read_declarations(path / "metadata", is_open);
    if (is_cut && !is_open) {
      note(fmt::format("'{}' is damaged or ends early: it does not describe all events", (path / "metadata").string()));
    }
    const std::string identity = declarations.uuid.empty() ? path.string() : declarations.uuid;
    const auto [known, is_new] = by_identity.try_emplace(identity, traces_.size());
    if (is_new) {
      traces_.push_back(std::make_unique<Trace>());
      traces_.back()->number = descriptions_.size();
      descriptions_.emplace_back();
      length.push_back(0);
    }
    Trace& trace = *traces_[known->second];
    descriptions_[known->second].directories.push_back(path);
    trace.is_open = trace.is_open || is_open;
    // The metadata of a session only grow, so the longest text is the newest.
    if (size >= length[known->second]) {
      trace.declarations = std::move(declarations);
      length[known->second] = size;
    }
  }

  std::vector<ClockOfTrace> clocks;
  for (const auto& trace : traces_) {
    trace->recording = recording_of_trace(trace->declarations);
    clocks.push_back({trace->recording, trace->declarations, descriptions_[trace->number].directories.front()});
  }
  if (one_clock) {
    clock_notes_ = put_on_one_clock(clocks);
    put_on_clock_of_launch(clocks, clock_notes_);
  }
  std::size_t next_class = 0;
  for (const auto& each : traces_) {
    Trace& trace = *each;
    descriptions_[trace.number].uuid = trace.declarations.uuid;
    descriptions_[trace.number].environment = trace.declarations.environment;
    for (const auto& [id, stream] : trace.declarations.streams) {
      trace.stream_classes[id] = std::make_unique<StreamClass>(trace.declarations, stream);
    }
    for (const ctf::EventDeclaration& event : trace.declarations.events) {
      EventClass& event_class = trace.event_classes.emplace_back();
      event_class.name = event.name;
      event_class.id = next_class++;
      event_class.trace = trace.number;
      event_class.recording = &trace.recording;
      const auto stream = trace.declarations.streams.find(event.stream_id);
      if (stream != trace.declarations.streams.end()) {
        add_names(stream->second.event_context, event_class.contexts);
      }
      event_class.stream_contexts = event_class.contexts.size();
      add_names(event.context, event_class.contexts);
      add_names(event.payload, event_class.fields);
    }
  }
}

DirectReader::~DirectReader() = default;

void DirectReader::note(const std::string& damage) {
  constexpr std::size_t kMost = 1000;  // lines; a large file may have millions of damaged packets
  if (damage_.size() < kMost) {
    damage_.push_back(damage);
  }
}

void DirectReader::open_trace(Trace& trace) {
  struct Found {
    std::string name;
    std::vector<ctf::Packet> packets;
  };
  std::map<std::tuple<std::uint64_t, std::optional<std::uint64_t>, std::string>, Found> found;
  const std::string domain(descriptions_[trace.number].text("domain"));
  for (const fs::path& path : descriptions_[trace.number].directories) {
    std::error_code gone;
    std::uint64_t bytes = 0;
    for (const fs::path& file : stream_files(path, gone)) {
      ctf::PacketList list;
      try {
        trace.files.push_back(std::make_unique<ctf::StreamFile>(file));
        list = find_packets(trace.declarations, *trace.files.back());
      } catch (const std::system_error& error) {
        note(fmt::format("'{}': {}", file.string(), error.code().message()));
      }
      if (trace.is_open && list.is_short) {
        // The tracer is about to write the rest of the packet.
        if (list.ends_early) {
          list.packets.pop_back();
        }
      } else if (trace.is_open && list.is_undescribed) {
        lacks_descriptions_ = true;
      } else if (!list.problem.empty()) {
        note(fmt::format("'{}', {}", file.string(), list.problem));
      }
      for (ctf::Packet& packet : list.packets) {
        bytes += packet.content_bits / 8;
        // A stream without a number of its own is one file.
        const std::string name = packet.stream_instance_id ? std::string() : file.string();
        Found& stream = found[{packet.stream_id, packet.stream_instance_id, name}];
        if (stream.name.empty()) {
          stream.name = shown_path(file);
        }
        stream.packets.push_back(std::move(packet));
      }
    }
    recorded_.add(path, domain, bytes);
    if (gone) {
      note(fmt::format("'{}': {}", path.string(), gone.message()));
    }
  }
  for (auto& [key, stream] : found) {
    put_in_order(stream.packets);
    for (const ctf::Packet& packet : stream.packets) {
      content_bytes_ += packet.content_bits / 8;
    }
    Stream description{stream.name, trace.number, trace.declarations.environment_number("vpid")};
    streams_.push_back(std::make_unique<OpenStream>(trace, *trace.stream_classes.at(std::get<0>(key)),
                                                    std::move(description), std::move(stream.packets)));
    streams_.back()->index = streams_.size() - 1;
  }
}

// Moves a stream to its next item. Where a packet is damaged, notes the damage and goes on behind it.
[[gnu::always_inline]] inline void DirectReader::advance(OpenStream& stream) {
  for (;;) {
    try {
      stream.item = stream.cursor.next();
      return;
    } catch (const ctf::DamagedPacket& damage) {
      note(stream, damage);
    }
  }
}

void DirectReader::note(const OpenStream& stream, const ctf::DamagedPacket& damage) {
  if (stream.trace.is_open && dynamic_cast<const ctf::UndescribedPacket*>(&damage) != nullptr) {
    lacks_descriptions_ = true;
    return;
  }
  const ctf::Packet& packet = stream.cursor.packet();
  note(fmt::format("'{}', the packet at byte {}: {}", stream.description.name, packet.offset, damage.what()));
}

namespace {

constexpr auto kLaterFirst = [](const auto* a, const auto* b) { return a->is_later_than(*b); };

}  // namespace

// Before the first item.
void DirectReader::find_streams() {
  if (are_found_) {
    return;
  }
  are_found_ = true;
  for (const auto& trace : traces_) {
    open_trace(*trace);
  }
  for (const std::string& line : damage_.empty() ? recorded_.missing() : std::vector<std::string>()) {
    note(line);
  }
  // What all streams have in memory is bounded as long as there are not too many of them.
  constexpr std::size_t kOfAll = 2 << 20;  // bytes
  const std::size_t of_each = streams_.empty() ? kOfAll : kOfAll / streams_.size();
  for (const auto& stream : streams_) {
    stream->cursor.set_block_size(std::clamp<std::size_t>(of_each, 32 << 10, 128 << 10));
  }
}

void DirectReader::open_streams() {
  is_begun_ = true;
  find_streams();
  for (const auto& stream : streams_) {
    advance(*stream);
    if (stream->item != ctf::StreamCursor::Item::kEnd) {
      later_.push_back(stream.get());
    }
  }
  std::make_heap(later_.begin(), later_.end(), kLaterFirst);
}

// Moves behind the item that was given. Returns whether there is another one.
[[gnu::always_inline]] inline bool DirectReader::advance_to_earliest() {
  if (!is_begun_) {
    open_streams();
  }
  if (earliest_ != nullptr) {
    advance(*earliest_);
    if (earliest_->item == ctf::StreamCursor::Item::kEnd) {
      earliest_ = nullptr;
    } else if (later_.empty() || !earliest_->is_later_than(*later_.front())) {
      return true;
    } else {
      later_.push_back(earliest_);
      std::push_heap(later_.begin(), later_.end(), kLaterFirst);
      earliest_ = nullptr;
    }
  }
  if (later_.empty()) {
    return false;
  }
  std::pop_heap(later_.begin(), later_.end(), kLaterFirst);
  earliest_ = later_.back();
  later_.pop_back();
  return true;
}

std::optional<EventCounts> DirectReader::count() {
  find_streams();
  std::vector<CountedStream> counted;
  for (const auto& stream : streams_) {
    counted.push_back({stream->cursor.layout(), stream->cursor.packets(),
                       std::vector<std::uint64_t>(stream->trace.event_classes.size())});
  }
  if (!count_packets(counted)) {
    return std::nullopt;
  }
  EventCounts counts;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    OpenStream& stream = *streams_[i];
    for (std::size_t index = 0; index < counted[i].counts.size(); ++index) {
      if (counted[i].counts[index] > 0) {
        counts.events.push_back({&stream.trace.event_classes[index], counted[i].counts[index]});
      }
    }
    for (const ctf::StreamLoss& loss : ctf::losses_of(counted[i].packets, counted[i].layout.clock())) {
      counts.losses.push_back(loss_of(loss, stream.description));
    }
  }
  return counts;
}

TraceItem DirectReader::next() {
  return advance_to_earliest() ? earliest_->give() : TraceItem();
}

void DirectReader::read(TraceSink& sink) {
  find_streams();
  constexpr std::uint64_t kLeast = 8 << 20;  // bytes, below which threads are not worth their start
  constexpr std::size_t kMostThreads = 3;    // more would wait for the one that gets the events
  const std::size_t others = usable_processors() - 1;
  const std::size_t threads = content_bytes_ < kLeast ? 0 : std::min({others, kMostThreads, streams_.size()});
  ctf::ReadAhead read_ahead(threads);
  struct Stop {
    std::vector<std::unique_ptr<OpenStream>>& streams;
    ~Stop() {
      for (const auto& stream : streams) {
        stream->cursor.stop_reading_ahead();
      }
    }
  } stop{streams_};
  for (const auto& stream : streams_) {
    if (threads > 0) {
      stream->cursor.read_ahead(read_ahead);
    }
  }
  while (advance_to_earliest()) {
    const TraceItem item = earliest_->give();
    if (item.event != nullptr) {
      sink.on_event(*item.event);
    } else {
      sink.on_loss(*item.loss);
    }
  }
}

void DirectReader::throw_damage() const {
  if (damage_.empty()) {
    return;
  }
  throw TraceReadError(fmt::format("the trace '{}' is damaged or ends early: {}", directory_.string(), damage_.front()),
                       "what can be read beside the damage was read");
}

}  // namespace tracing
