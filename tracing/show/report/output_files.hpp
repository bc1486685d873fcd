// SPDX-License-Identifier: Apache-2.0
// The files that `launch report` writes beside its text: a page, and the formats of other tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/model/selection/event_filter.hpp"
#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

// Empty names are not written.
struct OutputFiles {
  std::optional<TimeBound> from;     // only what begins from this time on
  std::optional<TimeBound> to;       // and before this time
  std::set<std::int64_t> processes;  // only userspace events of these; empty: of all
  bool all = false;                  // also of processes that are not of the launch

  std::filesystem::path html;
  std::filesystem::path perfetto;
  std::filesystem::path csv;  // a directory
  std::filesystem::path sqlite;
  std::filesystem::path otlp;
  std::filesystem::path dot;
  std::filesystem::path svg;
  std::filesystem::path analysis_model;  // a directory

  bool any() const { return needs_timeline() || !analysis_model.empty(); }
  // Any but analysis_model.
  bool needs_timeline() const;
  // The page, as a whole, and no other form that needs a timeline.
  bool is_page_alone() const;
};

// How much a page holds.
struct PageLimit {
  std::size_t records = 0;  // instances, messages and states of threads
  // The page is all that is made of the system, so the rest of it may be forgotten, and need not be there.
  TracedSystem* alone = nullptr;
};

// A form of output: an option of `launch report`, and the file or directory that it names.
struct OutputForm {
  const char* option;
  const char* type;
  const char* help;
  std::filesystem::path OutputFiles::*file;
  // Returns what is to be told beside the size. nullptr: it is written while the trace is read.
  std::string (*write)(const TracedSystem& system, const std::filesystem::path& file, const PageLimit& limit);
};

// In the order of the help.
std::span<const OutputForm> output_forms();

struct WrittenFiles {
  std::vector<std::string> lines;  // for people: "trace.html: 1.2 MB", "trace.html: 13.9 MB, the first 12.3 s of 100 s"
  std::string error;               // why reading stopped early; the files hold what was read before it
  std::vector<std::filesystem::path> open;  // traces that were still being written
  std::string incomplete;                   // incomplete_phrase()
  std::vector<OtherProcess> others;         // whose events were left out
};

// A page with more instances and messages than this would be too large for a browser; it holds the first of them.
inline constexpr std::size_t kMostInPage = 1'500'000;

// Reads the traces once, as one, and writes all files. Throws TraceReadError if the trace can't be read at all, and
// OutputError. `chains` are those that the user has named.
WrittenFiles write_files(const std::vector<std::filesystem::path>& directories, const OutputFiles& files,
                         const std::vector<ChainDefinition>& chains = {}, std::size_t most_in_page = kMostInPage);

}  // namespace tracing
