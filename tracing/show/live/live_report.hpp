// SPDX-License-Identifier: Apache-2.0
// Reports what a system does while it runs, and at the end what `launch report` says of the whole trace.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

struct LiveOptions {
  std::chrono::nanoseconds interval = std::chrono::seconds(1);  // between two drawings
  ReportOptions text{};
  bool json = false;         // the report at the end is JSON; lines before it go to standard error
  bool is_terminal = false;  // standard output
  std::function<std::vector<ChainDefinition>()> chains = {};  // the chains with names, of directories
};

// A live session: a URL or a name, as live_address() takes it. Waits until the relay daemon has it. Ends with the
// session, or when the user ends it. Returns false when the reading ended early. Throws TraceReadError.
bool report_live_session(const std::string& session, const LiveOptions& options);

// Directories that other programs may be writing to. Reads them anew for each drawing, so it shows the packets that are
// complete. Ends when nobody writes any more, or when the user ends it. Returns false when the trace is damaged. Throws
// TraceReadError.
bool report_growing_directories(const std::vector<std::filesystem::path>& directories, const LiveOptions& options);

}  // namespace tracing
