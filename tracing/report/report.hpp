// SPDX-License-Identifier: Apache-2.0
// Renders the results of an analysis: for people, for programs, and in one line.
#pragma once

#include <filesystem>
#include <string>

#include "tracing/analysis/results.hpp"

namespace tracing {

struct Report {
  std::filesystem::path directory;  // of the trace, absolute
  TraceResults results;
  std::string error;  // the reason why reading stopped early; empty when all was read
};

// The sections are: trace, losses (when there are any), events, callbacks, topics, notes. Lines have at most
// kReportWidth columns, except for longer names. Ends with a newline.
std::string text_report(const Report& report);

// One JSON object, documented in docs/report_format.md. Numbers are integers where the text says so; times are
// nanoseconds. Ends with a newline.
std::string json_report(const Report& report);

// For the launcher's last line; stable, without a newline:
//   "412 events, 2 processes, none lost"
//   "412 events, 2 processes, 37 events lost"
//   "412 events, 2 processes, 3 packets lost"
//   "412 events, 2 processes, 37 events and 3 packets lost", and "at least" before what could not be counted fully
//   "no events"
std::string summary_line(const TraceOverview& overview);

// The part of the summary about losses: "none lost", "at least 37 events lost", "some events lost".
std::string loss_phrase(const TraceOverview& overview);

// "ping [71]"
std::string process_label(const ProcessResult& process);

}  // namespace tracing
