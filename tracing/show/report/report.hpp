// SPDX-License-Identifier: Apache-2.0
// Renders the results of an analysis: for people, for programs, and in one line.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/timeline/other_process.hpp"
#include "tracing/show/report/recorded_facts.hpp"

namespace tracing {

struct Report {
  std::filesystem::path directory;  // of the trace, absolute; the first one of several
  TraceResults results;
  std::string error;  // the reason why reading stopped early; empty when all was read
  RecordedVerdict verdict = {};
  std::vector<std::filesystem::path> open = {};  // traces that were still being written
  bool lacks_descriptions = false;               // TraceReader::lacks_descriptions()
  std::vector<std::string> sessions = {};        // of one machine, if it has several
  std::vector<std::string> clocks = {};          // TraceReader::clock_notes()
  std::vector<OtherProcess> others = {};         // whose events were left out (launch_filter.hpp)
};

// What was not there: the sentences of the verdicts, and chains with names that never were gone through.
std::vector<std::string> absences_of(const Report& report);

// What a text report shows, and how.
struct ReportOptions {
  std::size_t width = 100;  // columns
  bool color = false;
  bool compact = false;                         // for a screen with few lines: each finding gets one line
  std::size_t top = 5;                          // rows of a table; 0: all
  std::string sort{};                           // one of sort_keys(); empty: by what matters most in each table
  std::string node{};                           // only nodes that match this pattern of the shell; empty: all
  std::string topic{};                          // likewise
  std::pair<std::string, std::string> chain{};  // only chains from one node to another, with their steps; empty: all
  bool events = false;                          // losses by stream, events by process
  bool all = false;                             // everything; of others, too, if the results have it
};

// "total", "count", "rate", "p50", "p99", "max", "name"
const std::vector<std::string>& sort_keys();

// Fits a screen: whether the trace is complete, what is most worth a look, then short tables. Lines have at most as
// many columns as the options say; names that are too long are cut in the middle. What is shown on demand may have
// longer lines. Ends with a newline.
std::string text_report(const Report& report, const ReportOptions& options = {});

// One JSON object, documented in docs/report_format.md. Numbers are integers where the text says so; times are
// nanoseconds. Ends with a newline.
std::string json_report(const Report& report);

// For the launcher's last line; stable, without a newline:
//   "412 events, 2 processes, none lost"
//   "412 events, 2 processes, 37 events lost"
//   "412 events, 2 processes, 3 packets lost"
//   "412 events, 2 processes, 37 events and 3 packets lost", and "at least" before what could not be counted fully
//   "412 events, 2 processes, none lost, 900 events overwritten, as asked"
//   "no events"
// Of several counts of a loss, that of the trace and that of its verdict, the greater one counts.
std::string summary_line(const TraceOverview& overview, const RecordedVerdict& verdict = {});

// The part of the summary about losses: "none lost", "at least 37 events lost", "some events lost".
std::string loss_phrase(const TraceOverview& overview, const RecordedVerdict& verdict = {});

// "2 processes", "1 process and 6911 more of the kernel's events"
std::string processes_phrase(const TraceOverview& overview);

bool has_losses(const TraceOverview& overview, const RecordedVerdict& verdict);

// What `--fail-on incomplete` fails on, beside damage: losses, or what the verdict says was not there. Empty: nothing.
std::string incomplete_phrase(const TraceOverview& overview, const RecordedVerdict& verdict);

}  // namespace tracing
