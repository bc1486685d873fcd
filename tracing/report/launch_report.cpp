// SPDX-License-Identifier: Apache-2.0
// `launch report DIRECTORY`: reads a trace and prints a report. `launch` executes this program, so that the launcher
// itself doesn't keep the reading libraries in memory while a system runs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "tracing/analysis/trace_analysis.hpp"
#include "tracing/report/recorded_processes.hpp"
#include "tracing/report/report.hpp"

namespace {

enum ExitCode { kSuccess = 0, kFailure = 1, kUsage = 2 };

struct Arguments {
  std::string directory;
  bool json = false;
  bool summary = false;
  bool recorded = false;
};

void print_error(const tracing::TraceReadError& error) {
  fmt::print(stderr, "launch report: error: {}\n", error.what());
  if (!error.remedy().empty()) fmt::print(stderr, "    = help: {}\n", error.remedy());
}

// Throws when the text can't be written.
void print_out(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  throw std::runtime_error(fmt::format("cannot write the output: {}", std::strerror(errno)));
}

int print_summary(const Arguments& arguments) {
  tracing::OverviewCounter counter;
  tracing::TraceReader(arguments.directory).read(counter);
  print_out(summary_line(counter.overview()) + "\n");
  return kSuccess;
}

int print_recorded(const Arguments& arguments) {
  tracing::RecordedProcessCounter counter;
  tracing::TraceReader reader(arguments.directory);
  reader.read(counter);
  print_out(counter.json() + "\n");
  return kSuccess;
}

int print_report(const Arguments& arguments) {
  tracing::TraceAnalysis analysis;
  // The paths of the streams have this form, so that they can be shown relative to it.
  tracing::Report report{std::filesystem::weakly_canonical(arguments.directory), {}, ""};
  tracing::TraceReader reader(arguments.directory);
  ExitCode exit_code = kSuccess;
  try {
    reader.read(analysis);
    report.results = analysis.finish();
  } catch (const tracing::TraceReadError& error) {
    report.results = analysis.finish();
    if (report.results.overview.events == 0) throw;
    report.error = error.what();
    print_error(error);
    exit_code = kFailure;
  }
  print_out(arguments.json ? json_report(report) : text_report(report));
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Reads a trace and reports events, losses, callback durations and topic latencies.", "launch report");
  app.add_option("directory", arguments.directory, "Directory of the trace, or one that holds several")->required();
  CLI::Option* json = app.add_flag("--json", arguments.json, "Print one JSON object instead of text");
  app.add_flag("--summary", arguments.summary, "Print one line: events, processes, losses")->excludes(json);
  // For the verdict of a session, which compares this with the events that the processes have fired.
  app.add_flag("--recorded", arguments.recorded)->group("");
  app.footer(
      "Exit code: 0, 1 when the trace can't be read (to its end) or the output can't be written, 2 for wrong "
      "arguments.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUsage;
  }

  try {
    if (arguments.recorded) return print_recorded(arguments);
    return arguments.summary ? print_summary(arguments) : print_report(arguments);
  } catch (const tracing::TraceReadError& error) {
    print_error(error);
    return kFailure;
  } catch (const std::exception& error) {
    std::fputs(fmt::format("launch report: error: {}\n", error.what()).c_str(), stderr);
    return kFailure;
  }
}
