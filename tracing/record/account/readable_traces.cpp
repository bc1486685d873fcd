// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/readable_traces.hpp"

#include <endian.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadataFile = "metadata";
constexpr const char* kAside = "unreadable";

// The files of one trace.
struct TraceFiles {
  bool has_metadata = false;
  std::vector<fs::path> streams;  // that are not empty
};

std::map<fs::path, TraceFiles> traces_in(const fs::path& folder) {
  std::map<fs::path, TraceFiles> traces;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code gone;
    const fs::path& file = entry->path();
    if (!entry->is_regular_file(gone) || file.parent_path().filename() == "index") {
      continue;
    }
    TraceFiles& trace = traces[file.parent_path()];
    if (file.filename() == kMetadataFile) {
      trace.has_metadata = true;
    } else if (entry->file_size(gone) != 0 && !gone) {
      trace.streams.push_back(file);
    }
  }
  return traces;
}

// Whether the first packet of a stream file is all of it and has no event. Its layout is LTTng-UST's, since the
// metadata do not tell it.
bool is_empty_stream(const fs::path& file) {
  constexpr std::streamoff kContentSize = 48;  // in bits, little endian, behind two times and the packet header
  constexpr std::uint64_t kHeaders = 84 * 8;   // bits
  std::uint64_t sizes[2] = {};
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(kContentSize);
  stream.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  std::error_code gone;
  return stream && le64toh(sizes[0]) <= kHeaders && le64toh(sizes[1]) / 8 >= fs::file_size(file, gone);
}

// Why a reader cannot open the trace, or "".
std::string why_unreadable(const fs::path& directory, const TraceFiles& trace) {
  if (!trace.has_metadata) {
    return "it has no metadata";
  }
  try {
    const ctf::TraceClass metadata = ctf::parse_metadata(ctf::read_metadata(directory / kMetadataFile));
    for (const fs::path& file : trace.streams) {
      const ctf::StreamFile stream(file);
      int packets = 0;
      if (ctf::find_packets(metadata, stream, [&packets] { return ++packets > 1; }).is_undescribed) {
        return "its metadata do not describe its streams";
      }
    }
  } catch (const ctf::UnsupportedTrace& error) {
    return fmt::format("its metadata cannot be read: {}", error.what());
  } catch (const std::system_error&) {
    return {};  // it is gone
  }
  return {};
}

}  // namespace

std::vector<UnreadableTrace> find_unreadable(const fs::path& folder) {
  std::vector<UnreadableTrace> unreadable;
  for (const auto& [path, trace] : traces_in(folder)) {
    std::string why = why_unreadable(path, trace);
    if (!why.empty()) {
      unreadable.push_back({.directory = path,
                            .why = std::move(why),
                            .is_empty = std::all_of(trace.streams.begin(), trace.streams.end(), is_empty_stream)});
    }
  }
  return unreadable;
}

std::vector<Absence> put_unreadable_aside(const fs::path& directory) {
  std::vector<Absence> absences;
  const fs::path processes = directory / "ust" / "pid";
  for (const UnreadableTrace& trace : find_unreadable(processes)) {
    // NAME of NAME[/64-bit].
    const fs::path name = *trace.directory.lexically_relative(processes).begin();
    std::error_code failed;
    fs::create_directories(directory / kAside, failed);
    fs::rename(trace.directory / kMetadataFile, trace.directory / "metadata.unreadable", failed);
    failed.clear();
    fs::rename(processes / name, directory / kAside / name, failed);
    if (failed || !trace.is_empty) {
      absences.push_back(
          {.text = fmt::format("the trace of process {} cannot be read: {}; it {}", name.string(), trace.why,
                               failed ? "could not be put aside: " + failed.message()
                                      : fmt::format("is in {}/{} now", kAside, name.string())),
           .is_loss = true});
    }
  }
  return absences;
}

std::string describe_unreadable(const fs::path& directory) {
  const std::vector<UnreadableTrace> unreadable = find_unreadable(directory / "ust" / "uid");
  if (!unreadable.empty()) {
    return fmt::format("the trace in {} cannot be read: {}",
                       unreadable.front().directory.lexically_relative(directory).string(), unreadable.front().why);
  }
  return {};
}

}  // namespace tracing
