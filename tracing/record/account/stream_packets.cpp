// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/stream_packets.hpp"

#include <endian.h>

#include <algorithm>
#include <charconv>
#include <fstream>
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
                         .sequence_number = packet.sequence_number,
                         .is_empty = packet.content_bits <= packet.events_bit});
    }
  } catch (const std::system_error&) {  // it is gone
  }
}

// The end of the last packet in an index file of LTTng, whose numbers are big endian; 0 when it has none.
std::uint64_t last_time_in(const fs::path& index) {
  constexpr std::size_t kLength = 12;  // behind magic number and version: the length of an entry
  constexpr std::size_t kHeader = 16;
  constexpr std::size_t kTimeEnd = 32;  // in an entry, behind offset, two sizes and the time of its begin
  std::ifstream file(index, std::ios::binary);
  const auto read_at = [&file](std::size_t at, auto number) {
    file.seekg(static_cast<std::streamoff>(at));
    file.read(reinterpret_cast<char*>(&number), sizeof number);
    return file ? number : 0;
  };
  const std::size_t length = be32toh(read_at(kLength, std::uint32_t{0}));
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  if (length < kTimeEnd + sizeof(std::uint64_t) || size < static_cast<std::streamoff>(kHeader + length)) {
    return 0;
  }
  const std::size_t entries = (static_cast<std::size_t>(size) - kHeader) / length;
  return be64toh(read_at(kHeader + (entries - 1) * length + kTimeEnd, std::uint64_t{0}));
}

// "20261122T190204+0000-1" of what was recorded since the last rotation, which becomes an archive at the end of the
// session, and what a rotation that has not ended has left.
bool is_chunk(const std::string& name) {
  return name == ".tmp_old_chunk" || (name.size() > 9 && is_number(name.substr(0, 8)) && name[8] == 'T');
}

// The session's directory and those of its archives.
std::vector<fs::path> chunks_of(const fs::path& directory) {
  std::vector<fs::path> chunks = {directory};
  std::error_code error;
  // Another program may move an archive away meanwhile.
  fs::directory_iterator archive(directory / "archives", error);
  for (; !error && archive != fs::directory_iterator(); archive.increment(error)) {
    chunks.push_back(archive->path());
  }
  error.clear();
  fs::directory_iterator entry(directory, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (is_chunk(entry->path().filename())) {
      chunks.push_back(entry->path());
    }
  }
  return chunks;
}

}  // namespace

std::vector<Stream> read_streams(const fs::path& directory, const std::set<std::string>& channels_in_files,
                                 const std::function<bool()>& give_up) {
  // Domain, path of the trace below it, channel, processor.
  std::map<std::tuple<std::string, fs::path, std::string, std::string>, std::vector<Packet>> found;
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
        std::vector<Packet>& packets =
            found[{domain, trace.lexically_relative(chunk / domain), name->channel, name->cpu}];
        if (const ctf::TraceClass* const metadata = traces.in(trace)) {
          add_packets(*metadata, entry.path(), give_up, packets);
        }
      }
    }
  }
  std::vector<Stream> streams;
  for (auto& [key, packets] : found) {
    std::stable_sort(packets.begin(), packets.end(), [](const Packet& a, const Packet& b) {
      return std::tie(a.sequence_number, a.begin) < std::tie(b.sequence_number, b.begin);
    });
    const auto& [domain, trace, channel, cpu] = key;
    streams.push_back({.domain = domain,
                       .channel = channel,
                       .cpu = cpu,
                       .pid = owner_of(trace),
                       .folder = trace.string(),
                       .packets = std::move(packets)});
  }
  std::stable_sort(streams.begin(), streams.end(), [](const Stream& a, const Stream& b) {
    return std::tie(a.domain, a.channel, a.cpu) < std::tie(b.domain, b.channel, b.cpu);
  });
  return streams;
}

std::vector<std::uint64_t> last_times(const fs::path& directory, const std::set<std::string>& channels_in_files) {
  std::map<std::tuple<fs::path, std::string, std::string>, std::uint64_t> ends;  // by folder, channel and processor
  std::error_code error;
  for (const fs::path& chunk : chunks_of(directory)) {
    const fs::path traces = chunk / "ust" / "uid";
    fs::recursive_directory_iterator entry(traces, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      if (entry->path().extension() != ".idx") {
        continue;
      }
      const fs::path folder = entry->path().parent_path().parent_path();
      const std::optional<FileName> name = stream_of(folder / entry->path().stem(), channels_in_files);
      if (name) {
        std::uint64_t& end = ends[{folder.lexically_relative(traces), name->channel, name->cpu}];
        end = std::max(end, last_time_in(entry->path()));
      }
    }
    error.clear();
  }
  std::vector<std::uint64_t> times;
  for (const auto& [stream, end] : ends) {
    times.push_back(end);
  }
  return times;
}

std::set<std::string> trace_uuids(const fs::path& directory) {
  std::set<std::string> uuids;
  Traces traces;
  for (const fs::path& chunk : chunks_of(directory)) {
    std::error_code error;
    fs::recursive_directory_iterator entry(chunk / "ust", error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      if (entry->path().filename() != kMetadata) {
        continue;
      }
      // LTTng may have made the file and not written it yet.
      const ctf::TraceClass* const trace = traces.in(entry->path().parent_path());
      if (trace != nullptr && !trace->uuid.empty()) {
        uuids.insert(trace->uuid);
      }
    }
  }
  return uuids;
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
