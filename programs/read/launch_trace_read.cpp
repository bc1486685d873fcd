// SPDX-License-Identifier: Apache-2.0
// `launch trace read DIRECTORY...`: prints the events of traces, or counts them. `launch` executes this program, so
// that the launcher itself links no libraries for reading traces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iterator>
#include <map>
#include <set>

#include "base/diagnostics/command_error.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "programs/read/event_printer.hpp"
#include "tracing/decode/reader/recorded_bytes.hpp"
#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/selection/event_filter.hpp"
#include "tracing/model/selection/missing_names.hpp"

namespace {

enum ExitCode { kSuccess = 0, kFailure = 1, kUsage = 2, kFailedOn = 3 };

struct Arguments {
  std::vector<std::filesystem::path> directories;
  tracing::EventFilter filter;
  std::string format = "text";
  bool count = false;
  std::string fail_on;
  std::optional<std::uint64_t> limit;
};

// The wanted number of events has been printed.
struct Enough {};

class PrintingSink : public tracing::TraceSink {
 public:
  PrintingSink(Arguments& arguments, tracing::EventPrinter& printer)
      : filter_(arguments.filter), printer_(printer), left_(arguments.limit) {}

  void on_event(const tracing::Event& event) override {
    if (filter_.is_behind(event)) {
      throw tracing::EndOfReading();
    }
    if (!filter_.accepts(event)) {
      return;
    }
    printer_.print(event);
    if (left_ && --*left_ == 0) {
      throw Enough();
    }
  }
  // A loss is never left out: it may have hidden the event that the user looks for.
  void on_loss(const tracing::Loss& loss) override { printer_.print(loss); }

 private:
  tracing::EventFilter& filter_;
  tracing::EventPrinter& printer_;
  std::optional<std::uint64_t> left_;
};

class CountingSink : public tracing::TraceSink {
 public:
  explicit CountingSink(tracing::EventFilter& filter, std::optional<std::uint64_t> limit = std::nullopt)
      : filter_(filter), left_(limit) {}
  std::map<std::string, std::uint64_t> counts() const {
    std::map<std::string, std::uint64_t> result;
    for (std::size_t id = 0; id < counts_.size(); ++id) {
      if (counts_[id] > 0) {
        result[names_[id]] += counts_[id];
      }
    }
    return result;
  }
  std::uint64_t lost_events = 0;
  std::uint64_t lost_packets = 0;
  bool lost_unknown = false;
  std::set<std::string> fields;  // and contexts

  // Counts without a look at each event, if that is possible. Returns false if the events must be read.
  bool count(tracing::TraceReader& reader, tracing::TraceSink& losses) {
    const std::optional<tracing::EventCounts> counted = filter_.is_of_names() ? reader.count() : std::nullopt;
    if (!counted) {
      return false;
    }
    for (const auto& [event_class, events] : counted->events) {
      if (filter_.accepts_name(*event_class)) {
        place_of(*event_class) += events;
      }
    }
    for (const tracing::Loss& loss : counted->losses) {
      losses.on_loss(loss);
    }
    reader.throw_damage();
    return true;
  }

  void on_event(const tracing::Event& event) override {
    if (filter_.is_behind(event)) {
      throw tracing::EndOfReading();
    }
    if (!filter_.accepts(event)) {
      return;
    }
    if (place_of(*event.event_class)++ == 0) {
      fields.insert(event.event_class->fields.begin(), event.event_class->fields.end());
      const std::vector<std::string>& contexts = event.event_class->contexts;
      std::copy_if(contexts.begin(), contexts.end(), std::inserter(fields, fields.end()),
                   [](const std::string& context) { return !tracing::has_own_place(context); });
    }
    if (left_ && --*left_ == 0) {
      throw Enough();
    }
  }
  void on_loss(const tracing::Loss& loss) override {
    (loss.kind == tracing::Loss::Kind::kEvents ? lost_events : lost_packets) += loss.count.value_or(0);
    if (!loss.count) {
      lost_unknown = true;
    }
  }

 private:
  std::uint64_t& place_of(const tracing::EventClass& event_class) {
    if (event_class.id >= counts_.size()) {
      counts_.resize(event_class.id + 1);
      names_.resize(event_class.id + 1);
    }
    if (counts_[event_class.id] == 0) {
      names_[event_class.id] = event_class.name;
    }
    return counts_[event_class.id];
  }

  tracing::EventFilter& filter_;
  std::optional<std::uint64_t> left_;
  std::vector<std::uint64_t> counts_;  // by EventClass::id
  std::vector<std::string> names_;
};

// Does not throw where the standard error output is closed, unlike fmt::print.
int print_error(const std::string& message, const std::string& remedy = "") {
  std::fputs(launch::command_error("launch trace read", message, remedy).c_str(), stderr);
  return kFailure;
}

int print_error(const tracing::TraceReadError& error) {
  return print_error(error.what(), error.remedy());
}

// Of such a trace only the complete packets are read.
void say_what_is_open(const tracing::TraceReader& reader) {
  for (const std::filesystem::path& directory : reader.open_directories()) {
    const std::string note =
        fmt::format("launch trace read: note: the trace '{}' is still being written; what is complete is read\n",
                    directory.string());
    std::fputs(note.c_str(), stderr);
  }
}

// Before the events, because nobody may look behind them.
void say_what_is_missing(const tracing::TraceReader& reader) {
  for (const std::string& line : reader.damage()) {
    std::fputs(fmt::format("launch trace read: warning: {}\n", line).c_str(), stderr);
  }
}

void say_that_nothing_is_called(std::string_view kind, const std::vector<std::string>& patterns,
                                const std::vector<std::string>& names) {
  const std::string text = tracing::nothing_is_called(kind, patterns, names);
  std::fputs(fmt::format("launch trace read: warning: {}\n", text).c_str(), stderr);
}

// Of what was asked for.
void say_what_is_not_there(const tracing::EventFilter& filter) {
  const tracing::NodeFilter* const nodes = filter.node_filter();
  if (!filter.nodes.empty() && (nodes == nullptr || !nodes->has_match())) {
    say_that_nothing_is_called("node", filter.nodes, nodes == nullptr ? std::vector<std::string>() : nodes->names());
  }
  for (const std::string& pattern : filter.missing_events()) {
    say_that_nothing_is_called("event", {pattern}, filter.event_names());
  }
  for (const std::string& process : filter.missing_processes()) {
    say_that_nothing_is_called("process", {process}, filter.process_names());
  }
}

// Passes on all, and notes whether something was lost.
class LossNote : public tracing::TraceSink {
 public:
  explicit LossNote(tracing::TraceSink& sink) : sink_(sink) {}
  bool has_losses = false;

  void on_event(const tracing::Event& event) override { sink_.on_event(event); }
  void on_loss(const tracing::Loss& loss) override {
    has_losses = true;
    sink_.on_loss(loss);
  }

 private:
  tracing::TraceSink& sink_;
};

// Reads as much as possible and returns the exit code. With a counter it is enough to count, if nothing else is wanted.
int read_all(const Arguments& arguments, tracing::TraceSink& sink, CountingSink* counter) {
  bool lacks_descriptions = false;
  try {
    tracing::TraceReader reader(arguments.directories);
    say_what_is_open(reader);
    say_what_is_missing(reader);
    if (arguments.limit != 0 && (counter == nullptr || !counter->count(reader, sink))) {
      reader.read(sink);
    }
    lacks_descriptions = reader.lacks_descriptions();
  } catch (const tracing::TraceReadError& error) {
    return print_error(error);
  } catch (const Enough&) {
    return kSuccess;
  }
  if (lacks_descriptions) {
    std::fputs(
        "launch trace read: note: events that LTTng has not described yet are left out; it describes them when a "
        "traced program ends or the session is stopped\n",
        stderr);
  }
  if (arguments.limit != 0) {
    say_what_is_not_there(arguments.filter);
  }
  return kSuccess;
}

int read_into(const Arguments& arguments, tracing::TraceSink& sink, CountingSink* counter = nullptr) {
  if (arguments.fail_on.empty()) {
    return read_all(arguments, sink, counter);
  }
  LossNote note(sink);
  const int exit_code = read_all(arguments, note, counter);
  if (exit_code != kSuccess) {
    return exit_code;
  }
  const std::vector<std::string> damage = tracing::recorded_damage(arguments.directories);
  if (!note.has_losses && damage.empty()) {
    return exit_code;
  }
  print_error("the trace is incomplete: " + (note.has_losses ? "events were lost" : damage.front()));
  return kFailedOn;
}

int print_count(Arguments& arguments) {
  CountingSink counter(arguments.filter);
  const int exit_code = read_into(arguments, counter, &counter);
  std::uint64_t total = 0;
  for (const auto& [name, count] : counter.counts()) {
    total += count;
  }
  const int width = std::max(5, static_cast<int>(std::to_string(total).size()));
  std::string text;
  for (const auto& [name, count] : counter.counts()) {
    text += fmt::format("{:>{}} {}\n", count, width, name);
  }
  text += fmt::format("{:>{}} in all\n", total, width);
  if (counter.lost_events > 0) {
    text += fmt::format("{:>{}} events lost\n", counter.lost_events, width);
  }
  if (counter.lost_packets > 0) {
    text += fmt::format("{:>{}} packets lost\n", counter.lost_packets, width);
  }
  if (counter.lost_unknown) {
    text += fmt::format("{:>{}} events were lost before the trace begins\n", "some", width);
  }
  tracing::write_out(stdout, text);
  return exit_code;
}

int print_events(Arguments& arguments) {
  std::unique_ptr<tracing::EventPrinter> printer;
  if (arguments.format == "csv") {
    // The columns are known only after a reading of all events that will be printed.
    CountingSink fields(arguments.filter, arguments.limit);
    try {
      tracing::TraceReader reader(arguments.directories);
      if (arguments.limit != 0) {
        reader.read(fields);
      }
    } catch (const tracing::TraceReadError&) {
      // The second reading, which prints, reports the error.
    } catch (const Enough&) {
    }
    arguments.filter.restart();
    printer = tracing::make_csv_printer(stdout, {fields.fields.begin(), fields.fields.end()});
  } else {
    printer = arguments.format == "json" ? tracing::make_json_printer(stdout) : tracing::make_text_printer(stdout);
  }
  PrintingSink sink(arguments, *printer);
  const int exit_code = read_into(arguments, sink);
  printer->flush();
  return exit_code;
}

std::optional<tracing::TimeBound> time_bound(const std::string& option, const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  if (const auto bound = tracing::TimeBound::parse(text)) {
    return bound;
  }
  throw CLI::ValidationError(option, fmt::format("'{}' is no time; write seconds since the epoch, "
                                                 "2026-01-31T12:00:00.5 or +SECONDS after the first event of the trace",
                                                 text));
}

void add_expression(tracing::EventFilter& filter, const std::string& text) {
  try {
    filter.conditions.emplace_back(text);
  } catch (const launch::LaunchError& error) {
    const launch::Diagnostic& mistake = error.diagnostics().front();
    throw CLI::ValidationError(
        "--where", fmt::format("{}\n    {}\n    {:>{}}", mistake.message, text, '^', mistake.where.begin + 1));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone then shows as an error of writing
  Arguments arguments;
  std::vector<std::string> expressions;
  std::string from;
  std::string to;
  CLI::App app("Prints the events of traces in the order of time, with the losses among them.", "launch trace read");
  app.add_option("directory", arguments.directories, "Directories of traces, or of several traces each")->required();
  app.add_option("--event", arguments.filter.events, "Only events of these names; * and ? stand for other characters")
      ->allow_extra_args(false);
  app.add_option("--process", arguments.filter.processes, "Only of these processes: ids, or names with * and ?")
      ->allow_extra_args(false);
  app.add_option("--node", arguments.filter.nodes,
                 "Only of these nodes: events of their objects, and all while their callbacks run; names with * and ?")
      ->allow_extra_args(false);
  app.add_option("--where", expressions,
                 "Only events for which this holds, such as 'queue_depth > 3 && topic_name =~ \"scan\"'")
      ->allow_extra_args(false);
  app.add_option("--from", from,
                 "Only from this time on: seconds since the epoch, 2026-01-31T12:00:00.5 (UTC), or +SECONDS "
                 "after the first event of the trace");
  app.add_option("--to", to, "Only before this time");
  app.add_option("--format", arguments.format, "text, json (one object a line) or csv")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->capture_default_str();
  app.add_option("--limit", arguments.limit, "Print at most so many events")->check([](const std::string& text) {
    return text.starts_with('-') ? fmt::format("'{}' is below 0", text) : std::string();
  });
  app.add_flag("--count", arguments.count, "Print how many events there are of each name instead")
      ->excludes("--format")
      ->excludes("--limit");
  app.add_option("--fail-on", arguments.fail_on,
                 "Exit with 3 if this is the case: incomplete (events or packets were lost)")
      ->option_text("WHAT")
      ->check(CLI::IsMember({"incomplete"}));
  app.footer(
      "Exit code: 0, 1 when a trace can't be read (to its end) or the output can't be written, 2 for wrong arguments, "
      "3 when it fails on what --fail-on names.");
  try {
    app.parse(argc, argv);
    arguments.filter.begin = time_bound("--from", from);
    arguments.filter.end = time_bound("--to", to);
    if (tracing::TimeBound::leave_nothing(arguments.filter.begin, arguments.filter.end)) {
      throw CLI::ValidationError("--to", fmt::format("'{}' is not after --from '{}'", to, from));
    }
    for (const std::string& expression : expressions) {
      add_expression(arguments.filter, expression);
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help
    }
    fmt::print(stderr, "{}", launch::usage_error_of(app, error));
    return kUsage;
  }
  try {
    return arguments.count ? print_count(arguments) : print_events(arguments);
  } catch (const tracing::OutputClosed& closed) {
    // A reader that has gone, as `head` does, has seen enough.
    if (closed.error == EPIPE) {
      return kFailure;
    }
    return print_error(fmt::format("cannot write the output: {}", std::strerror(closed.error)));
  } catch (const tracing::TraceReadError& error) {
    return print_error(error);
  } catch (const std::exception& error) {
    return print_error(error.what());
  }
}
