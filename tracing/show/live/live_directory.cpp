// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/show/live/live_report.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Reading {
  Report report;
  Clock::duration took{};
};

// nullopt when there is no trace yet: LTTng writes one when the first traced program has begun.
std::optional<Reading> read(const std::vector<fs::path>& directories, const LiveOptions& options) {
  const Clock::time_point begin = Clock::now();
  std::optional<TraceReader> reader;
  try {
    reader.emplace(directories);
  } catch (const TraceReadError&) {
    return std::nullopt;
  }
  Reading reading{.report = {directories.front(), {}, ""}};
  reading.report.open = reader->open_directories();
  TraceAnalysis analysis(nullptr, options.chains ? options.chains() : std::vector<ChainDefinition>());
  try {
    reader->read(analysis);
  } catch (const TraceReadError& error) {
    reading.report.error = error.what();
  }
  reading.report.results = analysis.finish();
  reading.report.lacks_descriptions = reader->lacks_descriptions();
  reading.took = Clock::now() - begin;
  return reading;
}

}  // namespace

bool report_growing_directories(const std::vector<fs::path>& directories, const LiveOptions& options) {
  LiveScreen screen(options);
  bool has_noted = false;
  std::optional<Reading> reading = read(directories, options);
  if (!reading) {
    screen.note("waiting for a trace in " + directories.front().string());
  }
  std::chrono::nanoseconds wait = options.interval;
  while (!reading || !reading->report.open.empty()) {
    if (reading) {
      const TraceOverview& overview = reading->report.results.overview;
      if (reading->report.lacks_descriptions && !has_noted) {
        screen.note("LTTng has not described all events yet; what comes from the first of them on is shown later");
        has_noted = true;
      }
      screen.show("Live", text_report(reading->report, options.text), summary_line(overview));
      // A large trace must not keep a processor busy.
      wait = std::max<std::chrono::nanoseconds>(options.interval, 4 * reading->took);
    }
    const bool is_over = screen.is_over_after(wait);
    std::optional<Reading> next = read(directories, options);
    if (next) {
      reading = std::move(next);
    }
    if (is_over) {
      break;
    }
  }
  if (!reading) {
    return true;
  }
  reading->report.verdict = read_verdicts(directories);
  screen.finish(reading->report);
  return reading->report.error.empty();
}

}  // namespace tracing
