// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/direct_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <system_error>
#include <tuple>

#include "tracing/ctf/event_layout.hpp"
#include "tracing/ctf/metadata_text.hpp"
#include "tracing/ctf/packet.hpp"
#include "tracing/ctf/stream_cursor.hpp"
#include "tracing/ctf/trace_class.hpp"
#include "tracing/reader/trace_read_error.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

// A context of every event of a stream.
struct Context {
  std::size_t index = 0;                // in the structure
  std::optional<std::uint32_t> offset;  // bytes from its beginning, for a usual type with a fixed place
};

// The parts that all events of one stream class share.
struct StreamClass {
  StreamClass(const ctf::TraceClass& trace, const ctf::StreamDeclaration& stream)
      : layout(trace, stream), vpid(context("vpid")), vtid(context("vtid")), procname(context("procname")) {}

  std::optional<Context> context(std::string_view name) const {
    const ctf::StructureDecoder& contexts = layout.event_context();
    const std::optional<std::size_t> index = contexts.index_of(name);
    if (!index) return std::nullopt;
    Context context{*index, std::nullopt};
    const ctf::FieldClass& type = *contexts.type()->members[*index].type;
    const bool is_usual = type.access == ctf::NumberAccess::kSigned32 || type.is_characters();
    if (contexts.fixed_size() && is_usual) context.offset = contexts.fixed_places()[*index].offset;
    return context;
  }

  ctf::StreamLayout layout;
  std::optional<Context> vpid;
  std::optional<Context> vtid;
  std::optional<Context> procname;
};

// Both functions write the value in its place: returning an optional takes longer than reading the value.
void read_number(const ctf::Record& contexts, const Context& context, std::optional<std::int64_t>& value) {
  if (!context.offset || contexts.base == nullptr) {
    value = contexts[context.index].integer();
    return;
  }
  std::int32_t number = 0;
  std::memcpy(&number, contexts.base + *context.offset, sizeof number);
  value.emplace(number);
}

void read_text(const ctf::Record& contexts, const Context& context, std::optional<std::string_view>& value) {
  if (!context.offset || contexts.base == nullptr) {
    value = contexts[context.index].string();
    return;
  }
  const auto* const bytes = reinterpret_cast<const char*>(contexts.base + *context.offset);
  value.emplace(bytes, strnlen(bytes, contexts.places[context.index].length));
}

// Sorts the packets of one stream, from all its files, by time. A packet that is in several snapshots counts once.
void put_in_order(std::vector<ctf::Packet>& packets) {
  const auto key = [](const ctf::Packet& packet) {
    return std::tuple(packet.time_begin, packet.sequence_number, packet.time_end, packet.content_bits);
  };
  std::stable_sort(packets.begin(), packets.end(),
                   [&](const ctf::Packet& a, const ctf::Packet& b) { return key(a) < key(b); });
  const auto same = [&](const ctf::Packet& a, const ctf::Packet& b) {
    return a.sequence_number && a.file != b.file && key(a) == key(b);
  };
  packets.erase(std::unique(packets.begin(), packets.end(), same), packets.end());
}

// The stream files of a trace, in the order of their names. What can't be listed, because another program has removed
// it, is noted in `problem`.
std::vector<fs::path> stream_files(const fs::path& directory, std::string& problem) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(directory, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename();
    std::error_code gone;
    if (entry->is_regular_file(gone) && name != "metadata" && !name.starts_with('.')) files.push_back(entry->path());
  }
  if (error && problem.empty()) problem = fmt::format("'{}': {}", directory.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

// Null, with the reason in `problem`, if the file can't be opened.
std::unique_ptr<ctf::MappedFile> map_file(const fs::path& file, std::string& problem) {
  try {
    return std::make_unique<ctf::MappedFile>(file);
  } catch (const std::system_error& error) {
    if (problem.empty()) problem = fmt::format("'{}': {}", file.string(), error.code().message());
    return nullptr;
  }
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
  std::vector<fs::path> directories;
  std::map<std::uint64_t, std::unique_ptr<StreamClass>> stream_classes;
  std::vector<EventClass> event_classes;  // by the number of the declaration
  std::vector<std::unique_ptr<ctf::MappedFile>> files;
};

// A stream that is being read.
struct DirectReader::OpenStream {
  OpenStream(Trace& of, const StreamClass& is, Stream as, std::vector<ctf::Packet> packets)
      : trace(of), stream_class(is), description(std::move(as)), cursor(is.layout, std::move(packets)) {}
  Trace& trace;
  const StreamClass& stream_class;
  Stream description;
  ctf::StreamCursor cursor;
  ctf::StreamCursor::Item item = ctf::StreamCursor::Item::kEnd;
  std::size_t index = 0;  // decides the order of equal times

  // Moves to the next item. Where a packet is damaged, notes the damage and goes on behind it.
  void advance(std::string& problem) {
    for (;;) {
      try {
        item = cursor.next();
        return;
      } catch (const ctf::DamagedPacket& damage) {
        if (problem.empty()) {
          const ctf::Packet& packet = cursor.packet();
          problem = fmt::format("'{}', the packet at byte {}: {}", description.name,
                                packet.begin - packet.file->begin(), damage.what());
        }
      }
    }
  }

  void give(TraceSink& sink);

 private:
  Event event_;  // its record always has the same address
};

void DirectReader::OpenStream::give(TraceSink& sink) {
  if (item == ctf::StreamCursor::Item::kEvent) {
    event_.event_class = &trace.event_classes[cursor.event().index];
    event_.timestamp_ns = cursor.time_ns();
    event_.cpu_id = cursor.packet().cpu_id;
    const ctf::Record& contexts = cursor.stream_context();
    if (stream_class.vpid) read_number(contexts, *stream_class.vpid, event_.vpid);
    if (stream_class.vtid) read_number(contexts, *stream_class.vtid, event_.vtid);
    if (stream_class.procname) read_text(contexts, *stream_class.procname, event_.procname);
    event_.record = &cursor.payload();
    sink.on_event(event_);
    return;
  }
  Loss loss;
  loss.kind = item == ctf::StreamCursor::Item::kDiscardedEvents ? Loss::Kind::kEvents : Loss::Kind::kPackets;
  loss.stream = &description;
  loss.begin_ns = cursor.time_ns();
  loss.end_ns = cursor.loss_end_ns();
  loss.count = cursor.lost();
  sink.on_loss(loss);
}

DirectReader::DirectReader(const fs::path& directory, const std::vector<fs::path>& traces) : directory_(directory) {
  std::map<std::string, std::size_t> by_identity;
  std::vector<std::size_t> length;  // of the metadata that each trace uses
  for (const fs::path& path : traces) {
    const std::string text = ctf::read_metadata(path / "metadata");
    ctf::TraceClass declarations = ctf::parse_metadata(text);
    const std::string identity = declarations.uuid.empty() ? path.string() : declarations.uuid;
    const auto [known, is_new] = by_identity.try_emplace(identity, traces_.size());
    if (is_new) {
      traces_.push_back(std::make_unique<Trace>());
      length.push_back(0);
    }
    Trace& trace = *traces_[known->second];
    trace.directories.push_back(path);
    // The metadata of a session only grow, so the longest text is the newest.
    if (text.size() >= length[known->second]) {
      trace.declarations = std::move(declarations);
      length[known->second] = text.size();
    }
  }

  std::size_t next_class = 0;
  for (std::size_t number = 0; number < traces_.size(); ++number) {
    Trace& trace = *traces_[number];
    for (const auto& [id, stream] : trace.declarations.streams) {
      trace.stream_classes[id] = std::make_unique<StreamClass>(trace.declarations, stream);
    }
    for (const ctf::EventDeclaration& event : trace.declarations.events) {
      EventClass& event_class = trace.event_classes.emplace_back();
      event_class.name = event.name;
      event_class.id = next_class++;
      event_class.trace = number;
      if (!event.payload) continue;
      for (const ctf::FieldMember& member : event.payload->members) event_class.fields.push_back(member.name);
    }
  }
}

DirectReader::~DirectReader() = default;

void DirectReader::read(TraceSink& sink) {
  std::string problem;
  std::vector<std::unique_ptr<OpenStream>> streams;
  for (std::size_t number = 0; number < traces_.size(); ++number) {
    Trace& trace = *traces_[number];
    struct Found {
      std::string name;
      std::vector<ctf::Packet> packets;
    };
    std::map<std::tuple<std::uint64_t, std::optional<std::uint64_t>, std::string>, Found> found;
    for (const fs::path& path : trace.directories) {
      for (const fs::path& file : stream_files(path, problem)) {
        std::unique_ptr<ctf::MappedFile> mapped = map_file(file, problem);
        if (!mapped) continue;
        trace.files.push_back(std::move(mapped));
        ctf::PacketList list = find_packets(trace.declarations, *trace.files.back());
        if (!list.problem.empty() && problem.empty()) problem = fmt::format("'{}', {}", file.string(), list.problem);
        for (ctf::Packet& packet : list.packets) {
          // A stream without a number of its own is one file.
          const std::string name = packet.stream_instance_id ? std::string() : file.string();
          Found& stream = found[{packet.stream_id, packet.stream_instance_id, name}];
          if (stream.name.empty()) stream.name = shown_path(file);
          stream.packets.push_back(std::move(packet));
        }
      }
    }
    for (auto& [key, stream] : found) {
      put_in_order(stream.packets);
      Stream description{stream.name, number, trace.declarations.environment_number("vpid")};
      streams.push_back(std::make_unique<OpenStream>(trace, *trace.stream_classes.at(std::get<0>(key)),
                                                     std::move(description), std::move(stream.packets)));
      streams.back()->index = streams.size() - 1;
    }
  }

  // The streams with something left; the first one has the earliest item.
  std::vector<OpenStream*> heap;
  const auto later = [](const OpenStream* a, const OpenStream* b) {
    return std::tuple(a->cursor.time_ns(), a->index) > std::tuple(b->cursor.time_ns(), b->index);
  };
  for (const auto& stream : streams) {
    stream->advance(problem);
    if (stream->item != ctf::StreamCursor::Item::kEnd) heap.push_back(stream.get());
  }
  std::make_heap(heap.begin(), heap.end(), later);
  try {
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), later);
      OpenStream* const earliest = heap.back();
      const OpenStream* const next = heap.size() > 1 ? heap.front() : nullptr;
      // As long as this stream stays the earliest.
      do {
        earliest->give(sink);
        earliest->advance(problem);
      } while (earliest->item != ctf::StreamCursor::Item::kEnd && (next == nullptr || later(next, earliest)));
      if (earliest->item == ctf::StreamCursor::Item::kEnd) {
        heap.pop_back();
      } else {
        std::push_heap(heap.begin(), heap.end(), later);
      }
    }
  } catch (const EndOfReading&) {
    // The sink needs no more.
  }
  if (!problem.empty()) {
    throw TraceReadError(fmt::format("the trace '{}' is damaged or ends early: {}", directory_.string(), problem),
                         "what can be read beside the damage was read");
  }
}

}  // namespace tracing
