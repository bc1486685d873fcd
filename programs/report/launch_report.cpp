// SPDX-License-Identifier: Apache-2.0
// `launch report DIRECTORY`: reads a trace and prints a report, or compares traces. `launch` executes this program, so
// that the launcher itself doesn't keep the reading libraries in memory while a system runs.
#include <fmt/format.h>
#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/terminal/terminal.hpp"
#include "programs/report/report_arguments.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/selection/missing_names.hpp"
#include "tracing/show/live/live_report.hpp"
#include "tracing/show/report/comparison_command.hpp"
#include "tracing/show/report/launch_filter.hpp"
#include "tracing/show/report/output_files.hpp"
#include "tracing/show/report/recorded_facts.hpp"
#include "tracing/show/report/recorded_processes.hpp"
#include "tracing/show/report/report.hpp"

namespace {

using report::Arguments;
using report::ExitCode, report::kFailedOn, report::kFailure, report::kSuccess;

void print_error(const std::string& error, const std::string& remedy = "") {
  fmt::print(stderr, "{}", launch::command_error("launch report", error, remedy));
}

// Throws when the text can't be written.
void print_out(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) {
    return;
  }
  throw std::runtime_error(fmt::format("cannot write the output: {}", std::strerror(errno)));
}

// What the terminal allows: as many columns as it has, and as many rows of each table as fit with all tables on it.
tracing::ReportOptions text_options(const Arguments& arguments) {
  tracing::ReportOptions options = arguments.text;
  if (arguments.chain.size() == 2) {
    options.chain = {arguments.chain[0], arguments.chain[1]};
  }
  options.color = launch::shows_colour(STDOUT_FILENO);
  if (isatty(STDOUT_FILENO) == 1) {
    constexpr std::size_t kLeastWidth = 60;
    const auto [columns, lines] = launch::terminal_size(STDOUT_FILENO);
    if (columns > 0) {
      options.width = std::max(columns, kLeastWidth);
    }
    // The head, the findings, and a blank and a title for each table; then the prompt.
    constexpr std::size_t kTables = 4;
    constexpr std::size_t kFindings = 8;  // at most, and seldom
    constexpr std::size_t kOtherLines = 4 + 2 + kFindings + 2 * kTables + 1;
    constexpr std::size_t kFurtherLines = 2 * kFindings;
    options.compact = lines > 0 && lines < kOtherLines + kFurtherLines + kTables;
    const std::size_t others = options.compact ? kOtherLines : kOtherLines + kFurtherLines;
    if (lines > 0) {
      options.top = lines > others + kTables ? (lines - others) / kTables : 1;
    }
  }
  if (arguments.top) {
    options.top = *arguments.top;
  }
  return options;
}

// What follows from what is missing, if that is no damage: nothing, unless the user wants it to fail.
int judge(const Arguments& arguments, const std::string& incomplete) {
  if (incomplete.empty() || arguments.comparison.fail_on.empty()) {
    return kSuccess;
  }
  print_error("the trace is incomplete: " + incomplete);
  return kFailedOn;
}

// For what is printed without a word on it.
void say_what_is_open(const std::vector<std::filesystem::path>& open) {
  for (const std::filesystem::path& directory : open) {
    fmt::print(stderr, "launch report: note: the trace '{}' is still being written; what is complete is read\n",
               directory.string());
  }
}

int print_summary(const Arguments& arguments) {
  tracing::OverviewCounter counter;
  tracing::TraceReader reader(arguments.paths);
  say_what_is_open(reader.open_directories());
  reader.read(counter);
  const tracing::RecordedVerdict verdict = tracing::read_verdicts(arguments.paths);
  print_out(summary_line(counter.overview(), verdict) + "\n");
  return judge(arguments, incomplete_phrase(counter.overview(), verdict));
}

int print_recorded(const Arguments& arguments) {
  tracing::RecordedProcessCounter counter;
  tracing::TraceReader reader(arguments.paths);
  reader.read(counter);
  print_out(counter.json() + "\n");
  return kSuccess;
}

// The chains with names. A file that does not hold chains costs no result but those of its chains.
std::vector<tracing::ChainDefinition> named_chains(const std::vector<std::filesystem::path>& paths) {
  std::vector<tracing::ChainDefinition> chains;
  for (const std::filesystem::path& path : paths) {
    try {
      for (tracing::ChainDefinition& chain : tracing::read_chains(path)) {
        if (std::find(chains.begin(), chains.end(), chain) == chains.end()) {
          chains.push_back(std::move(chain));
        }
      }
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "launch report: warning: {}\n", error.what());
    }
  }
  return chains;
}

int write_files(const Arguments& arguments) {
  const tracing::WrittenFiles written =
      tracing::write_files(arguments.paths, arguments.files, named_chains(arguments.paths));
  say_what_is_open(written.open);
  if (!written.others.empty()) {
    fmt::print(stderr, "launch report: note: {}\n", tracing::others_phrase(written.others));
  }
  for (const std::string& line : written.lines) {
    print_out(line + "\n");
  }
  if (written.error.empty()) {
    return judge(arguments, written.incomplete);
  }
  print_error(written.error);
  return kFailure;
}

int report_live(const Arguments& arguments) {
  tracing::LiveOptions options;
  options.interval = std::chrono::nanoseconds(static_cast<std::int64_t>(arguments.interval_s * 1e9));
  options.text = text_options(arguments);
  options.json = arguments.json;
  options.is_terminal = launch::takes_control_sequences(STDOUT_FILENO);
  options.chains = [&arguments] { return named_chains(arguments.paths); };
  const bool is_session = arguments.directories.size() == 1 && !std::filesystem::is_directory(arguments.directories[0]);
  const bool is_whole = is_session ? report_live_session(arguments.directories[0], options)
                                   : report_growing_directories(arguments.paths, options);
  return is_whole ? kSuccess : kFailure;
}

int print_comparison(const Arguments& arguments) {
  tracing::ReportOptions options = text_options(arguments);
  options.top = arguments.top.value_or(10);
  tracing::ComparisonArguments comparison = arguments.comparison;
  comparison.html = arguments.files.html;
  if (!comparison.html.empty()) {
    comparison.chains = named_chains({comparison.diff.begin(), comparison.diff.end()});
  }
  const tracing::ComparisonOutcome outcome = tracing::compare_runs(comparison, arguments.paths, options);
  print_out(outcome.text);
  return outcome.failed ? kFailedOn : kSuccess;
}

int save_baseline(const Arguments& arguments) {
  const tracing::SavedBaseline saved = tracing::save_baseline(arguments.comparison, arguments.paths);
  print_out(saved.text + "\n");
  if (!saved.incomplete.empty()) {
    fmt::print(stderr, "launch report: warning: the trace of this run is incomplete: {}\n", saved.incomplete);
  }
  return judge(arguments, saved.incomplete);
}

void warn_of_missing(std::string_view kind, const std::string& pattern, std::set<std::string> names) {
  names.erase("");
  const bool fits = std::any_of(names.begin(), names.end(), [&pattern](const std::string& name) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
  if (pattern.empty() || fits) {
    return;
  }
  const std::string text = tracing::nothing_is_called(kind, {pattern}, {names.begin(), names.end()});
  fmt::print(stderr, "launch report: warning: {}\n", text);
}

// Of the nodes and topics that the user asked for.
void say_what_is_not_there(const tracing::ReportOptions& options, const tracing::Ros2Results& ros2) {
  std::set<std::string> nodes;
  for (const tracing::NodeResult& node : ros2.nodes) {
    nodes.insert(node.name);
  }
  warn_of_missing("node", options.node, std::move(nodes));
  std::set<std::string> topics;
  for (const tracing::TopicResult& topic : ros2.topics) {
    topics.insert(topic.name);
  }
  warn_of_missing("topic", options.topic, std::move(topics));
}

int print_report(const Arguments& arguments) {
  tracing::TraceAnalysis analysis(nullptr, named_chains(arguments.paths));
  tracing::Report report{arguments.paths.front(), {}, ""};
  report.verdict = tracing::read_verdicts(arguments.paths);
  tracing::TraceReader reader(arguments.paths, tracing::TraceReader::Clocks::kOne);
  report.open = reader.open_directories();
  tracing::LaunchFilter filter(reader, arguments.paths, analysis, arguments.text.all);
  ExitCode exit_code = kSuccess;
  try {
    reader.read(filter);
    report.results = analysis.finish();
  } catch (const tracing::TraceReadError& error) {
    analysis.doubt_all();
    report.results = analysis.finish();
    if (report.results.overview.events == 0) {
      throw;
    }
    report.error = error.what();
    print_error(error.what(), error.remedy());
    exit_code = kFailure;
  }
  report.others = filter.others();
  say_what_is_not_there(arguments.text, report.results.ros2);
  report.lacks_descriptions = reader.lacks_descriptions();
  report.clocks = reader.clock_notes();
  report.sessions = tracing::several_sessions(reader.traces());
  print_out(arguments.json ? json_report(report) : text_report(report, text_options(arguments)));
  return exit_code == kSuccess ? judge(arguments, incomplete_phrase(report.results.overview, report.verdict))
                               : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (const std::optional<int> done = report::parse_arguments(argc, argv, arguments)) {
    return *done;
  }
  try {
    for (const std::string& directory : arguments.directories) {
      // The paths of the streams have this form, so that they can be shown relative to it.
      const std::filesystem::path path = std::filesystem::weakly_canonical(directory);
      if (std::find(arguments.paths.begin(), arguments.paths.end(), path) == arguments.paths.end()) {
        arguments.paths.push_back(path);
      }
    }
    if (arguments.live) {
      return report_live(arguments);
    }
    if (arguments.recorded) {
      return print_recorded(arguments);
    }
    if (arguments.comparison.compares()) {
      return print_comparison(arguments);
    }
    if (!arguments.comparison.save_baseline.empty()) {
      return save_baseline(arguments);
    }
    if (arguments.files.any()) {
      return write_files(arguments);
    }
    return arguments.summary ? print_summary(arguments) : print_report(arguments);
  } catch (const tracing::TraceReadError& error) {
    print_error(error.what(), error.remedy());
    return kFailure;
  } catch (const std::exception& error) {
    print_error(error.what());
    return kFailure;
  }
}
