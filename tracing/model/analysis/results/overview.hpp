// SPDX-License-Identifier: Apache-2.0
// What a trace holds, and what it has lost.
#pragma once

#include "tracing/model/analysis/results/field.hpp"

namespace tracing {

struct ProcessResult {
  std::optional<std::int64_t> vpid;
  std::string name;
  std::uint64_t events = 0;
  bool doubtful = false;
  std::string host;
  std::uint64_t folded = 0;  // 0: it has events of its own

  static const Field<ProcessResult> kFields[];
};
inline constexpr Field<ProcessResult> ProcessResult::kFields[] = {
    {"vpid", &ProcessResult::vpid,
     "`null`: all events that were recorded without the context `vpid`, or of several processes"},
    {"name", &ProcessResult::name, "`procname` of its main thread, else of the first thread seen"},
    {"host", &ProcessResult::host, "name of the machine"},
    {"events", &ProcessResult::events, ""},
    {"folded", &ProcessResult::folded,
     "how many processes of this name have events of the kernel alone; these stand behind the others. 0: one process "
     "with events of its own",
     trait::kNotOnPage},
    {"doubtful", &ProcessResult::doubtful,
     "a buffer that the process may have used lost events, or a part of the trace is missing"},
};

// The place of a process in TraceOverview::processes.
using ProcessIndex = std::size_t;

struct EventCount {
  std::string name;
  std::uint64_t total = 0;
  std::vector<std::uint64_t> by_process;

  static const Field<EventCount> kFields[];
};
inline constexpr Field<EventCount> EventCount::kFields[] = {
    {"name", &EventCount::name, "what Python programs log is counted by logger: `lttng_python:event (LOGGER)`"},
    {"total", &EventCount::total,
     "the launcher's own events (`launch:exec`) are in it alone, because the launcher is not one of the traced "
     "processes"},
    {"by_process", &EventCount::by_process, "list, one for each process, in the order of `processes`"},
};

// The losses of one stream (one buffer).
struct LossResult {
  std::string stream;
  std::uint64_t events = 0;
  std::uint64_t packets = 0;
  bool uncounted = false;
  std::optional<std::int64_t> begin_ns;
  std::optional<std::int64_t> end_ns;
  std::vector<std::size_t> processes;

  static const Field<LossResult> kFields[];
};
inline constexpr Field<LossResult> LossResult::kFields[] = {
    {"stream", &LossResult::stream, "path of the stream's file"},
    {"events", &LossResult::events, "dropped events, as far as they were counted"},
    {"packets", &LossResult::packets, "overwritten before they were written out"},
    {"uncounted", &LossResult::uncounted, "more was lost, of unknown number"},
    {"begin_ns", &LossResult::begin_ns, "the losses are between this time", trait::kTime},
    {"end_ns", &LossResult::end_ns, "and this one", trait::kTime},
    {"processes", &LossResult::processes, "list of indices in `processes`: those that may have lost events here",
     trait::kNotInTables},
};

struct TraceOverview {
  std::uint64_t events = 0;
  std::optional<std::int64_t> begin_ns;  // first event, nullopt when there is none
  std::optional<std::int64_t> end_ns;    // last event
  std::vector<ProcessResult> processes;  // by host and vpid; then those of the kernel's events alone, by host and name
  std::vector<EventCount> event_counts;  // by name
  std::vector<LossResult> losses;        // by stream; empty: nothing was lost

  std::uint64_t folded_processes() const;  // that have events of the kernel alone
  std::uint64_t lost_events() const;
  std::uint64_t lost_packets() const;
  bool lost_uncounted() const;
};

}  // namespace tracing
