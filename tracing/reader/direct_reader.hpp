// SPDX-License-Identifier: Apache-2.0
// Reads traces with our own decoder (tracing/ctf). Private to the reader.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tracing/reader/trace_sink.hpp"

namespace tracing {

class DirectReader {
 public:
  // `traces` are the directories with metadata below `directory`. Throws ctf::UnsupportedTrace when another reader
  // must read them, TraceReadError when no reader can.
  DirectReader(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& traces);
  ~DirectReader();

  // As TraceReader::read().
  void read(TraceSink& sink);

 private:
  struct Trace;
  struct OpenStream;

  std::filesystem::path directory_;
  std::vector<std::unique_ptr<Trace>> traces_;
};

}  // namespace tracing
