// SPDX-License-Identifier: Apache-2.0
// Reads traces into what pages, exports and tables are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <vector>

#include "tracing/decode/reader/trace_sink.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

struct SystemOptions {
  std::vector<ChainDefinition> chains = {};  // those that the user has named
  bool with_details = false;                 // Timeline::details, which the tables need
  bool with_analysis = true;                 // false: only `beside` gets the events
  std::set<std::int64_t> processes = {};     // only userspace events of these; empty: of all
  bool all = false;                          // also of processes that are not of the launch (launch_filter.hpp)
  std::size_t most_records = 0;              // TimelineRecorder::keep_first(); 0: all
  TraceSink* beside = nullptr;               // also gets the events
  ExecutionSink* also = nullptr;             // is told what the timeline is told
  std::function<void(const ObjectModel& objects)> at_begin = {};
  std::function<void(const TraceAnalysis& analysis, const TraceResults& results)> at_end = {};  // after the analysis
};

// Reads the traces once, as one. What ends the reading early, or is known to be missing, is TracedSystem::error. Throws
// TraceReadError if they can't be read at all.
TracedSystem read_system(const std::vector<std::filesystem::path>& directories, const SystemOptions& options);

}  // namespace tracing
