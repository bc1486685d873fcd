// SPDX-License-Identifier: Apache-2.0
#include "programs/report/report_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/diagnostics/command_error.hpp"

namespace report {

namespace {

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
                                                 "2026-01-31T12:00:00.5 or +SECONDS after the first event of the trace",
                                                 text));
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
  if (comparison.compares()) {
    for (const tracing::OutputForm& form : tracing::output_forms()) {
      const bool is_page = form.file == &tracing::OutputFiles::html;
      if (app.count(form.option) > 0 && (!is_page || comparison.diff.empty())) {
        throw CLI::ValidationError(form.option, is_page ? "goes with --diff; a baseline has nothing to show"
                                                        : "does not go with --diff or --baseline");
      }
    }
    for (const char* option : {"--from", "--to"}) {
      if (app.count(option) > 0) {
        throw CLI::ValidationError(option, "does not go with --diff or --baseline");
      }
    }
  }
  const auto& fail_on = comparison.fail_on;
  const auto other =
      std::find_if(fail_on.begin(), fail_on.end(), [](const std::string& word) { return word != "incomplete"; });
  if (other != fail_on.end() && !comparison.compares()) {
    throw CLI::ValidationError("--fail-on", fmt::format("'{}' goes with --diff or --baseline", *other));
  }
  for (const char* option : {"--least", "--confidence"}) {
    if (app.count(option) > 0 && !comparison.compares()) {
      throw CLI::ValidationError(option, "goes with --diff or --baseline");
    }
  }
  if (comparison.append && comparison.save_baseline.empty()) {
    throw CLI::ValidationError("--append", "goes with --save-baseline");
  }
}

// They choose what the text shows, which --live draws in any case. All else has everything, and would pass over them
// without a word.
void check_text_options(const CLI::App& app, const Arguments& arguments) {
  const bool writes_files_alone = arguments.files.any() && !arguments.comparison.compares();
  if (arguments.live || (!arguments.json && !arguments.summary && !writes_files_alone)) {
    return;
  }
  for (const char* option : {"--top", "--sort", "--node", "--topic", "--chain", "--events"}) {
    if (app.count(option) > 0) {
      throw CLI::ValidationError(option,
                                 fmt::format("is for the text, and {} has everything", arguments.json      ? "--json"
                                                                                       : arguments.summary ? "--summary"
                                                                                                           : "a file"));
    }
  }
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
                 "Exit with 3 if the comparison finds one of these, separated by commas: " + words +
                     "; without a comparison: incomplete")
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
         "Changes that are smaller than this part or this time do not count; default: 10%,20us")
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

std::optional<int> parse_arguments(int argc, char** argv, Arguments& arguments) {
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
  app.add_option("--top", arguments.top, "Rows of each table; 0: all")
      ->option_text("N")
      ->check([](const std::string& text) {
        return text.starts_with('-') ? fmt::format("'{}' is below 0", text) : std::string();
      });
  app.add_option("--sort", arguments.text.sort, "What tables are sorted by: " + keys)
      ->option_text("KEY")
      ->check(CLI::IsMember(tracing::sort_keys()));
  app.add_option("--node", arguments.text.node, "Only nodes that match this pattern: '/camera*'")->option_text("NODE");
  app.add_option("--topic", arguments.text.topic, "Only topics that match this pattern")->option_text("TOPIC");
  app.add_option("--chain", arguments.chain, "Only chains from node A to node B, with their steps")
      ->option_text("A B")
      ->expected(2);
  app.add_flag("--events", arguments.text.events, "Also losses by buffer, and events by process");
  app.add_flag("--all", arguments.text.all,
               "Everything; of the recording of a launch also the processes that do not belong to the launch");
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
                 "(UTC), or +SECONDS after the first event of the trace")
      ->excludes(json)
      ->excludes(summary);
  app.add_option("--to", to, "Only what begins before this time")->excludes(json)->excludes(summary);
  app.footer(
      "Exit code: 0, 1 when the trace can't be read (to its end) or the output can't be written, 2 for wrong "
      "arguments, 3 when it fails on what --fail-on names.");
  try {
    app.parse(argc, argv);
    check_comparison(app, arguments);
    check_text_options(app, arguments);
    arguments.files.from = time_bound("--from", from, arguments.files);
    arguments.files.to = time_bound("--to", to, arguments.files);
    if (tracing::TimeBound::leave_nothing(arguments.files.from, arguments.files.to)) {
      throw CLI::ValidationError("--to", fmt::format("'{}' is not after --from '{}'", to, from));
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help
    }
    fmt::print(stderr, "{}", launch::usage_error_of(app, error));
    return kUsage;
  }
  arguments.comparison.json = arguments.json;
  arguments.comparison.all = arguments.files.all = arguments.text.all;
  return std::nullopt;
}

}  // namespace report
