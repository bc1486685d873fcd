// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/stream_packets.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadata = "metadata";

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "ros2" and "0" of a file ros2_0, or of ros2_0_3 where the channel is recorded into numbered files.
struct FileName {
  std::string channel;
  std::string cpu;
};

std::optional<FileName> split(const std::string& name) {
  const std::size_t separator = name.rfind('_');
  if (separator == std::string::npos || !is_number(std::string_view(name).substr(separator + 1))) {
    return std::nullopt;
  }
  return FileName{name.substr(0, separator), name.substr(separator + 1)};
}

std::optional<FileName> stream_of(const fs::path& file, const std::set<std::string>& channels_in_files) {
  // The name of a channel may hold a dot.
  if (file.parent_path().filename() == "index") {
    return std::nullopt;
  }
  std::optional<FileName> name = split(file.filename());
  if (!name) {
    return std::nullopt;
  }
  std::optional<FileName> of_numbered_file = split(name->channel);
  return of_numbered_file && channels_in_files.contains(of_numbered_file->channel) ? of_numbered_file : name;
}

// 123 of …/pid/NAME-123-20261121-190000[/64-bit].
std::optional<std::int64_t> owner_of(const fs::path& trace) {
  constexpr std::size_t kTimeStamp = std::string_view("-YYYYMMDD-HHMMSS").size();
  auto part = trace.begin();
  if (part == trace.end() || *part != "pid" || ++part == trace.end()) {
    return std::nullopt;
  }
  std::string name = *part;
  if (name.size() <= kTimeStamp) {
    return std::nullopt;
  }
  name.resize(name.size() - kTimeStamp);
  std::int64_t pid = 0;
  const char* const digits = name.data() + name.rfind('-') + 1;
  const bool read = std::from_chars(digits, name.data() + name.size(), pid).ec == std::errc();
  return read ? std::optional(pid) : std::nullopt;
}

// The metadata of each directory is parsed once.
class Traces {
 public:
  const ctf::TraceClass* in(const fs::path& directory) {
    const auto [found, is_new] = traces_.try_emplace(directory);
    if (!is_new) {
      return found->second ? &*found->second : nullptr;
    }
    try {
      found->second = ctf::parse_metadata(ctf::read_metadata(directory / kMetadata));
    } catch (const ctf::UnsupportedTrace&) {
      return nullptr;
    }
    return &*found->second;
  }

 private:
  std::map<fs::path, std::optional<ctf::TraceClass>> traces_;
};

void add_packets(const ctf::TraceClass& trace, const fs::path& file, const std::function<bool()>& give_up,
                 std::vector<Packet>& packets) {
  try {
    const ctf::StreamFile stream(file);
    ctf::PacketList list = ctf::find_packets(trace, stream, give_up);
    if (list.ends_early) {
      list.packets.pop_back();
    }
    for (const ctf::Packet& packet : list.packets) {
      packets.push_back({.begin = packet.time_begin.value_or(0),
                         .end = packet.time_end.value_or(0),
                         .bytes = packet.content_bits / 8,
                         .discarded_events = packet.discarded_events.value_or(0),
                         .sequence_number = packet.sequence_number});
    }
  } catch (const std::system_error&) {  // it is gone
  }
}

// The parts of one stream.
struct Found {
  bool in_archives = false;
  std::vector<Packet> packets = {};
};

// The session's directory and those of its archives.
std::vector<fs::path> chunks_of(const fs::path& directory) {
  std::vector<fs::path> chunks = {directory};
  std::error_code error;
  // Another program may move an archive away meanwhile.
  fs::directory_iterator archive(directory / "archives", error);
  for (; !error && archive != fs::directory_iterator(); archive.increment(error)) {
    chunks.push_back(archive->path());
  }
  return chunks;
}

}  // namespace

std::vector<Stream> read_streams(const fs::path& directory, const std::set<std::string>& channels_in_files,
                                 const std::function<bool()>& give_up) {
  // Domain, path of the trace below it, channel, processor.
  std::map<std::tuple<std::string, fs::path, std::string, std::string>, Found> found;
  Traces traces;
  for (const fs::path& chunk : chunks_of(directory)) {
    for (const char* domain : {"ust", "kernel"}) {
      std::error_code error;
      fs::recursive_directory_iterator iterator(chunk / domain, error);
      for (; !error && iterator != fs::recursive_directory_iterator(); iterator.increment(error)) {
        const fs::directory_entry& entry = *iterator;
        std::error_code gone;
        if (!entry.is_regular_file(gone)) {
          continue;
        }
        const std::optional<FileName> name = stream_of(entry.path(), channels_in_files);
        if (!name) {
          continue;
        }
        const fs::path trace = entry.path().parent_path();
        Found& stream = found[{domain, trace.lexically_relative(chunk / domain), name->channel, name->cpu}];
        if (chunk != directory) {
          stream.in_archives = true;
        }
        if (const ctf::TraceClass* const metadata = traces.in(trace)) {
          add_packets(*metadata, entry.path(), give_up, stream.packets);
        }
      }
    }
  }
  std::vector<Stream> streams;
  for (auto& [key, parts] : found) {
    std::vector<Packet>& packets = parts.packets;
    std::stable_sort(packets.begin(), packets.end(), [](const Packet& a, const Packet& b) {
      return std::tie(a.sequence_number, a.begin) < std::tie(b.sequence_number, b.begin);
    });
    const auto& [domain, trace, channel, cpu] = key;
    streams.push_back({.domain = domain,
                       .channel = channel,
                       .cpu = cpu,
                       .pid = owner_of(trace),
                       .in_archives = parts.in_archives,
                       .packets = std::move(packets)});
  }
  std::stable_sort(streams.begin(), streams.end(), [](const Stream& a, const Stream& b) {
    return std::tie(a.domain, a.channel, a.cpu) < std::tie(b.domain, b.channel, b.cpu);
  });
  return streams;
}

std::uint64_t first_time(const std::vector<Stream>& streams) {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  for (const Stream& stream : streams) {
    if (!stream.packets.empty()) {
      first = std::min(first, stream.packets.front().begin);
    }
  }
  return first;
}

}  // namespace tracing
