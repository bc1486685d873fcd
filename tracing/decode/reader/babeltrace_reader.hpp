// SPDX-License-Identifier: Apache-2.0
// Reads the traces that our own decoder does not know, with libbabeltrace2. Private to the reader.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

class BabeltraceReader {
 public:
  // `traces` are the directories with metadata below `directory`. Throws TraceReadError.
  BabeltraceReader(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& traces);
  ~BabeltraceReader();

  // Adds a line to damage().
  void note(const std::string& damage);
  // As in TraceReader.
  TraceItem next();
  void throw_damage() const;
  const std::vector<std::string>& damage() const;
  const std::deque<TraceDescription>& traces() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tracing
