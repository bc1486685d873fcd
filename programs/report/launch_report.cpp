// SPDX-License-Identifier: Apache-2.0
// `launch report DIRECTORY`: reads a trace and prints a report, or compares traces. `launch` executes this program, so
// that the launcher itself doesn't keep the reading libraries in memory while a system runs.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>

#include "base/diagnostics/command_error.hpp"
#include "base/terminal/terminal.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/show/live/live_report.hpp"
#include "tracing/show/report/comparison_command.hpp"
#include "tracing/show/report/output_files.hpp"
#include "tracing/show/report/recorded_facts.hpp"
#include "tracing/show/report/recorded_processes.hpp"
#include "tracing/show/report/report.hpp"

namespace {

enum ExitCode { kSuccess = 0, kFailure = 1, kUsage = 2, kComparisonFailed = 3 };

struct Arguments {
  std::vector<std::string> directories;
  std::vector<std::filesystem::path> paths;  // of these, each one once
  bool json = false;
  tracing::ReportOptions text;
  std::optional<std::size_t> top;
  std::vector<std::string> chain;
  bool summary = false;
  bool recorded = false;
  bool live = false;
  double interval_s = 1;
  tracing::OutputFiles files;
  tracing::ComparisonArguments comparison;
};

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
    constexpr std::size_t kOtherLines = 4 + 7 + 2 * kTables + 1;
    constexpr std::size_t kSecondLines = 5;  // of findings
    options.compact = lines > 0 && lines < kOtherLines + kSecondLines + 3 * kTables;
    const std::size_t others = options.compact ? kOtherLines : kOtherLines + kSecondLines;
    if (lines > 0) {
      options.top = lines > others + kTables ? (lines - others) / kTables : 1;
    }
  }
  if (arguments.top) {
    options.top = *arguments.top;
  }
  return options;
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
  const std::string missing = missing_content(verdict, reader);
  if (missing.empty()) {
    return kSuccess;
  }
  print_error(missing);
  return kFailure;
}

int print_recorded(const Arguments& arguments) {
  tracing::RecordedProcessCounter counter;
  tracing::TraceReader reader(arguments.paths);
  reader.read(counter);
  print_out(counter.json() + "\n");
  return kSuccess;
}

std::optional<tracing::TimeBound> time_bound(const std::string& option, const std::string& text,
                                             const tracing::OutputFiles& files) {
  if (text.empty()) {
    return std::nullopt;
  }
  if (!files.any()) {
    throw CLI::ValidationError(option, "goes with the options that write files, such as --html");
  }
  if (const auto bound = tracing::TimeBound::parse(text)) {
    return bound;
  }
  throw CLI::ValidationError(option, fmt::format("'{}' is no time; write seconds since the epoch, "
                                                 "2026-01-31T12:00:00.5 or +SECONDS after the first event",
                                                 text));
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
  for (const std::string& line : written.lines) {
    print_out(line + "\n");
  }
  if (written.error.empty()) {
    return kSuccess;
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
  const tracing::ComparisonOutcome outcome = tracing::compare_runs(arguments.comparison, arguments.paths, options);
  print_out(outcome.text);
  return outcome.failed ? kComparisonFailed : kSuccess;
}

int save_baseline(const Arguments& arguments) {
  print_out(tracing::save_baseline(arguments.comparison, arguments.paths) + "\n");
  return kSuccess;
}

// What the options of a comparison need besides what CLI11 checks.
void check_comparison(const CLI::App& app, const Arguments& arguments) {
  const tracing::ComparisonArguments& comparison = arguments.comparison;
  if (arguments.directories.empty() && comparison.diff.empty()) {
    throw CLI::RequiredError("directory");
  }
  if (!arguments.directories.empty() && !comparison.diff.empty()) {
    throw CLI::ValidationError("--diff", "takes both traces itself; no other directory goes with it");
  }
  for (const char* option : {"--fail-on", "--least", "--confidence"}) {
    if (app.count(option) > 0 && !comparison.compares()) {
      throw CLI::ValidationError(option, "goes with --diff or --baseline");
    }
  }
  if (comparison.append && comparison.save_baseline.empty()) {
    throw CLI::ValidationError("--append", "goes with --save-baseline");
  }
}

int print_report(const Arguments& arguments) {
  tracing::TraceAnalysis analysis(nullptr, named_chains(arguments.paths));
  tracing::Report report{arguments.paths.front(), {}, ""};
  report.verdict = tracing::read_verdicts(arguments.paths);
  tracing::TraceReader reader(arguments.paths);
  report.open = reader.open_directories();
  ExitCode exit_code = kSuccess;
  try {
    reader.read(analysis);
    report.results = analysis.finish();
  } catch (const tracing::TraceReadError& error) {
    report.results = analysis.finish();
    if (report.results.overview.events == 0) {
      throw;
    }
    report.error = error.what();
    print_error(error.what(), error.remedy());
    exit_code = kFailure;
  }
  if (report.error.empty()) {
    report.error = missing_content(report.verdict, reader);
    if (!report.error.empty()) {
      print_error(report.error);
      exit_code = kFailure;
    }
  }
  report.lacks_descriptions = reader.lacks_descriptions();
  report.sessions = tracing::several_sessions(reader.traces());
  print_out(arguments.json ? json_report(report) : text_report(report, text_options(arguments)));
  return exit_code;
}

void add_comparison(CLI::App& app, Arguments& arguments) {
  tracing::ComparisonArguments& comparison = arguments.comparison;
  CLI::Option* diff = app.add_option("--diff", comparison.diff,
                                     "Compare two runs, A before and B after: directories of traces, or baselines")
                          ->option_text("A B")
                          ->expected(2);
  CLI::Option* baseline =
      app.add_option("--baseline", comparison.baseline, "Compare with the runs of a baseline, which are before")
          ->type_name("FILE")
          ->excludes(diff);
  app.add_option("--save-baseline", comparison.save_baseline, "Write what is needed of the run to compare it later")
      ->type_name("FILE")
      ->excludes(diff)
      ->excludes(baseline);
  app.add_flag("--append", comparison.append, "Add the run to those of the baseline");
  std::string words;
  for (const std::string& word : tracing::fail_words()) {
    words += (words.empty() ? "" : ", ") + word;
  }
  app.add_option("--fail-on", comparison.fail_on,
                 "Exit with 3 if the comparison finds one of these, separated by commas: " + words)
      ->option_text("WHAT")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(tracing::fail_words()));
  app.add_option_function<std::vector<std::string>>(
         "--least",
         [&comparison](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             if (tracing::set_least(comparison.options, text)) {
               continue;
             }
             throw CLI::ValidationError(
                 "--least", fmt::format("'{}' is no change; write a part such as 5% or a time such as 20us", text));
           }
         },
         "Changes that are smaller than this part or this time do not count; default: 10%,100us")
      ->option_text("CHANGE")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option_function<std::string>(
         "--confidence",
         [&comparison](const std::string& text) {
           const auto confidence = tracing::confidence_of(text);
           if (confidence) {
             comparison.options.confidence = *confidence;
             return;
           }
           throw CLI::ValidationError(
               "--confidence", fmt::format("'{}' is no confidence; write a part above 50% and below 100%", text));
         },
         "How sure it must be that none of the changes is there by chance; default: 99%")
      ->option_text("PART");
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Reads traces and reports what is most worth a look: chains, callbacks, topics, executors, losses.",
               "launch report");
  std::string keys;
  for (const std::string& key : tracing::sort_keys()) {
    keys += (keys.empty() ? "" : ", ") + key;
  }
  app.add_option("directory", arguments.directories, "Directories of traces, or of what holds traces");
  CLI::Option* json = app.add_flag("--json", arguments.json, "Print one JSON object instead of text");
  CLI::Option* summary =
      app.add_flag("--summary", arguments.summary, "Print one line: events, processes, losses")->excludes(json);
  CLI::Option* live =
      app.add_flag("--live", arguments.live,
                   "Show what happens while it happens: of a live session (its name, or net://RELAY/host/HOST/SESSION) "
                   "or of directories that are being written to. Ends with the session, then prints the report")
          ->excludes(summary);
  app.add_option("--interval", arguments.interval_s, "Seconds between two drawings of --live")
      ->option_text("SECONDS")
      ->check(CLI::Range(0.1, 3600.0))
      ->needs(live);
  // Instead of printing a report; several may be given.
  for (const tracing::OutputForm& form : tracing::output_forms()) {
    app.add_option(form.option, arguments.files.*form.file, form.help)
        ->type_name(form.type)
        ->excludes(json)
        ->excludes(summary)
        ->excludes(live);
  }
  app.add_option("--top", arguments.top, "Rows of each table; 0: all")->option_text("N");
  app.add_option("--sort", arguments.text.sort, "What tables are sorted by: " + keys)
      ->option_text("KEY")
      ->check(CLI::IsMember(tracing::sort_keys()));
  app.add_option("--node", arguments.text.node, "Only nodes that match this pattern: '/camera*'")->option_text("NODE");
  app.add_option("--topic", arguments.text.topic, "Only topics that match this pattern")->option_text("TOPIC");
  app.add_option("--chain", arguments.chain, "Only chains from node A to node B, with their steps")
      ->option_text("A B")
      ->expected(2);
  app.add_flag("--events", arguments.text.events, "Also losses by buffer, and events by process");
  app.add_flag("--all", arguments.text.all, "Everything");
  add_comparison(app, arguments);
  for (const char* option : {"--diff", "--baseline", "--save-baseline"}) {
    live->excludes(app.get_option(option));
  }
  // For the verdict of a session, which compares this with the events that the processes have fired.
  app.add_flag("--recorded", arguments.recorded)->group("");
  // For the page of a test, whose session has recorded the tests beside it, too.
  app.add_option("--processes", arguments.files.processes)->delimiter(',')->group("");
  std::string from;
  std::string to;
  app.add_option("--from", from,
                 "Only what begins from this time on goes to files: seconds since the epoch, 2026-01-31T12:00:00.5 "
                 "(UTC), or +SECONDS")
      ->excludes(json)
      ->excludes(summary);
  app.add_option("--to", to, "Only what begins before this time")->excludes(json)->excludes(summary);
  app.footer(
      "Exit code: 0, 1 when the trace can't be read (to its end) or the output can't be written, 2 for wrong "
      "arguments, 3 when a comparison fails on what --fail-on names.");
  try {
    app.parse(argc, argv);
    check_comparison(app, arguments);
    arguments.files.from = time_bound("--from", from, arguments.files);
    arguments.files.to = time_bound("--to", to, arguments.files);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help
    }
    fmt::print(stderr, "{}", launch::usage_error_of(app, error));
    return kUsage;
  }

  arguments.comparison.json = arguments.json;
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
