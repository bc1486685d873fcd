// SPDX-License-Identifier: Apache-2.0
#include "tracing/reader/trace_reader.hpp"

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
    : implementation_(std::make_unique<Implementation>()) {
  const std::vector<std::filesystem::path> traces = find_traces(directory);
  if (decoder != Decoder::kBabeltrace) {
    try {
      implementation_->direct = std::make_unique<DirectReader>(directory, traces);
      return;
    } catch (const ctf::UnsupportedTrace& unsupported) {
      if (decoder == Decoder::kDirect) throw TraceReadError(unsupported.what(), "");
    }
  }
  implementation_->babeltrace = std::make_unique<BabeltraceReader>(directory, traces);
}

TraceReader::~TraceReader() = default;

void TraceReader::read(TraceSink& sink) {
  if (implementation_->direct) {
    implementation_->direct->read(sink);
  } else {
    implementation_->babeltrace->read(sink);
  }
}

}  // namespace tracing
