// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/trace_reader.hpp"

#include <set>
#include <string>
#include <utility>

#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/babeltrace_reader.hpp"
#include "tracing/decode/reader/direct/direct_reader.hpp"
#include "tracing/decode/reader/missing_files.hpp"
#include "tracing/decode/reader/open_trace.hpp"
#include "tracing/decode/reader/recorded_bytes.hpp"
#include "tracing/decode/reader/trace_discovery.hpp"

namespace tracing {

struct TraceReader::Implementation {
  std::vector<std::filesystem::path> open_directories;
  std::unique_ptr<DirectReader> direct;
  std::unique_ptr<BabeltraceReader> babeltrace;
};

TraceReader::TraceReader(const std::filesystem::path& directory, Decoder decoder)
    : TraceReader(std::vector{directory}, decoder) {}

TraceReader::TraceReader(const std::vector<std::filesystem::path>& directories, Decoder decoder, Clocks clocks)
    : implementation_(std::make_unique<Implementation>()) {
  std::vector<std::filesystem::path> traces;
  std::vector<std::string> missing;
  std::string names;  // for messages
  for (const std::filesystem::path& directory : directories) {
    const std::vector<std::filesystem::path> found = find_traces(directory);
    traces.insert(traces.end(), found.begin(), found.end());
    const std::vector<std::string> lines = missing_metadata(directory);
    missing.insert(missing.end(), lines.begin(), lines.end());
    names += (names.empty() ? "" : "', '") + directory.string();
  }
  // One directory may lie within another one.
  std::set<std::filesystem::path> seen;
  std::erase_if(traces, [&seen](const std::filesystem::path& trace) {
    return !seen.insert(std::filesystem::weakly_canonical(trace)).second;
  });
  RecordedBytes recorded(directories);
  missing.insert(missing.end(), recorded.broken().begin(), recorded.broken().end());
  std::vector<std::filesystem::path>& open = implementation_->open_directories;
  for (const std::filesystem::path& trace : traces) {
    if (is_being_written(trace)) {
      open.push_back(trace);
      continue;
    }
    const std::vector<std::string> lines = missing_packets(trace);
    missing.insert(missing.end(), lines.begin(), lines.end());
  }
  if (decoder != Decoder::kBabeltrace) {
    try {
      implementation_->direct = std::make_unique<DirectReader>(names, traces, open, clocks == Clocks::kOne);
      for (const std::string& line : missing) {
        implementation_->direct->note(line);
      }
      if (open.empty() && missing.empty()) {
        implementation_->direct->expect(std::move(recorded));
      }
      return;
    } catch (const ctf::UnsupportedTrace& unsupported) {
      if (decoder == Decoder::kDirect) {
        throw TraceReadError(unsupported.what(), "");
      }
    }
  }
  implementation_->babeltrace = std::make_unique<BabeltraceReader>(names, traces);
  for (const std::string& line : missing) {
    implementation_->babeltrace->note(line);
  }
}

TraceReader::~TraceReader() = default;

void TraceReader::read(TraceSink& sink) {
  try {
    if (implementation_->direct) {
      implementation_->direct->read(sink);
    } else {
      while (const TraceItem item = next()) {
        if (item.event != nullptr) {
          sink.on_event(*item.event);
        } else {
          sink.on_loss(*item.loss);
        }
      }
    }
  } catch (const EndOfReading&) {
    // The sink needs no more.
  }
  throw_damage();
}

std::optional<EventCounts> TraceReader::count() {
  return implementation_->direct ? implementation_->direct->count() : std::nullopt;
}

TraceItem TraceReader::next() {
  return implementation_->direct ? implementation_->direct->next() : implementation_->babeltrace->next();
}

void TraceReader::throw_damage() const {
  if (implementation_->direct) {
    implementation_->direct->throw_damage();
  } else {
    implementation_->babeltrace->throw_damage();
  }
}

std::vector<std::string> TraceReader::clock_notes() const {
  return implementation_->direct ? implementation_->direct->clock_notes() : std::vector<std::string>();
}

const std::vector<std::string>& TraceReader::damage() const {
  return implementation_->direct ? implementation_->direct->damage() : implementation_->babeltrace->damage();
}

const std::vector<std::filesystem::path>& TraceReader::open_directories() const {
  return implementation_->open_directories;
}

bool TraceReader::lacks_descriptions() const {
  return implementation_->direct && implementation_->direct->lacks_descriptions();
}

std::optional<std::uint64_t> TraceReader::content_bytes() const {
  return implementation_->direct ? std::optional(implementation_->direct->content_bytes()) : std::nullopt;
}

const std::deque<TraceDescription>& TraceReader::traces() const {
  return implementation_->direct ? implementation_->direct->traces() : implementation_->babeltrace->traces();
}

}  // namespace tracing
