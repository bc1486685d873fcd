// SPDX-License-Identifier: Apache-2.0
// Reads the traces that our own decoder does not know, with libbabeltrace2. Private to the reader.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tracing/reader/trace_sink.hpp"

namespace tracing {

class BabeltraceReader {
 public:
  // `traces` are the directories with metadata below `directory`. Throws TraceReadError.
  BabeltraceReader(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& traces);
  ~BabeltraceReader();

  // As TraceReader::read().
  void read(TraceSink& sink);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tracing
