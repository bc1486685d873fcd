// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/trace_reader.hpp"

#include <string>

#include "tracing/ctf/trace_class.hpp"
#include "tracing/reader/babeltrace_reader.hpp"
#include "tracing/reader/direct_reader.hpp"
#include "tracing/reader/trace_discovery.hpp"

namespace tracing {

struct TraceReader::Implementation {
  std::unique_ptr<DirectReader> direct;
  std::unique_ptr<BabeltraceReader> babeltrace;
};

TraceReader::TraceReader(const std::filesystem::path& directory, Decoder decoder)
    : TraceReader(std::vector{directory}, decoder) {}

TraceReader::TraceReader(const std::vector<std::filesystem::path>& directories, Decoder decoder)
    : implementation_(std::make_unique<Implementation>()) {
  std::vector<std::filesystem::path> traces;
  std::string names;  // for messages
  for (const std::filesystem::path& directory : directories) {
    const std::vector<std::filesystem::path> found = find_traces(directory);
    traces.insert(traces.end(), found.begin(), found.end());
    names += (names.empty() ? "" : "', '") + directory.string();
  }
  if (decoder != Decoder::kBabeltrace) {
    try {
      implementation_->direct = std::make_unique<DirectReader>(names, traces);
      return;
    } catch (const ctf::UnsupportedTrace& unsupported) {
      if (decoder == Decoder::kDirect) throw TraceReadError(unsupported.what(), "");
    }
  }
  implementation_->babeltrace = std::make_unique<BabeltraceReader>(names, traces);
}

TraceReader::~TraceReader() = default;

void TraceReader::read(TraceSink& sink) {
  if (implementation_->direct) {
    implementation_->direct->read(sink);
    return;
  }
  try {
    implementation_->babeltrace->read(sink);
  } catch (const EndOfReading&) {
    // It reports damage where it meets it, so there is none so far.
  }
}

}  // namespace tracing
