// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/trace_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <type_traits>

#include "actions/trace/trace_settings.hpp"
#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"

namespace tracing {
namespace {

// As typed; the defaults that depend on the environment are not filled in yet.
struct SessionArguments {
  std::string session_name;
  std::string path;
  launch::TraceRequest request;
  bool dual_session = false;
};

// An option that takes any number of names; without names it means "none". It appears as `{name}` to the parser then.
void add_names(CLI::App& command, const std::string& option, std::vector<std::string>& names, const std::string& kind,
               const std::string& help) {
  command
      .add_option_function<std::vector<std::string>>(
          option,
          [&names](const std::vector<std::string>& given) {
            names = given;
            std::erase(names, std::string());
          },
          help)
      ->expected(0, CLI::detail::expected_max_vector_size)
      ->option_text(fmt::format("[{}…]", kind));
}

std::string is_name(const std::string& name) {
  return name.empty() ? "the name of a session is not empty" : "";
}

std::string not_negative(const std::string& number) {
  return number.starts_with('-') ? fmt::format("expected a number that is not negative, got '{}'", number) : "";
}

// Lets the option write to the place of the setting.
void add_option(CLI::App& command, const launch::SettingOption& option, const launch::SettingPlace& place) {
  std::visit(
      [&](const auto& at) {
        using Place = std::decay_t<decltype(at)>;
        if constexpr (std::is_same_v<Place, launch::SettingChoice>) {
          std::map<std::string, std::size_t> numbers;
          for (const std::string& word : at.words) {
            numbers.emplace(word, numbers.size());
          }
          command.add_option_function<std::size_t>(option.flags, at.choose, option.help)
              ->transform(CLI::Transformer(numbers))
              ->option_text(option.unit);
        } else if constexpr (std::is_same_v<Place, std::vector<std::string>*>) {
          add_names(command, option.flags, *at, option.unit, option.help);
        } else if constexpr (std::is_same_v<Place, bool*>) {
          command.add_flag(option.flags, *at, option.help);
        } else if constexpr (std::is_same_v<Place, launch::NumberFromZero>) {
          command.add_option(option.flags, *at.number, option.help)->option_text(option.unit)->check(not_negative);
        } else if constexpr (std::is_same_v<Place, std::chrono::nanoseconds*>) {
          command
              .add_option_function<double>(
                  option.flags,
                  [at](double seconds) {
                    *at = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
                  },
                  option.help)
              ->option_text(option.unit)
              ->check(not_negative);
        } else {
          CLI::Option* const made = command.add_option(option.flags, *at, option.help)->option_text(option.unit);
          if constexpr (!std::is_same_v<Place, std::int64_t*> && !std::is_same_v<Place, std::string*>) {
            made->check(not_negative);  // the parser would take -5 for a huge number
          }
        }
      },
      place);
}

void add_session_options(CLI::App& command, SessionArguments& arguments, TraceOptions& options) {
  command
      .add_option("-p,--path", arguments.path,
                  "directory that will hold the trace directory (default: $ROS_TRACE_DIR, $ROS_HOME/tracing or "
                  "~/.ros/tracing)")
      ->option_text("DIR");
  for (const auto& setting : launch::trace_settings()) {
    if (!setting.option.flags.empty()) {
      add_option(command, setting.option, setting.place(arguments.request));
    }
  }
  command.add_flag("-l,--list", options.list_names, "print the names of the enabled events and context fields");
}

void add_fail_on_loss(CLI::App& command, SessionArguments& arguments) {
  command.add_flag("--fail-on-loss", arguments.request.config.fail_on_loss, "exit with 1 when events were lost");
}

void add_dual_session(CLI::App& command, SessionArguments& arguments) {
  command.add_flag("-d,--dual-session", arguments.dual_session, "act on a dual session, whose snapshot half exists");
}

// The options of the verbs.

void take_session(CLI::App& verb, SessionArguments& arguments, TraceOptions& /*options*/) {
  verb.add_option("session_name", arguments.session_name, "name of the session")
      ->required()
      ->check(is_name)
      ->option_text("NAME");
  add_dual_session(verb, arguments);
}

void take_start(CLI::App& verb, SessionArguments& arguments, TraceOptions& options) {
  take_session(verb, arguments, options);
  add_session_options(verb, arguments, options);
}

void take_stop(CLI::App& verb, SessionArguments& arguments, TraceOptions& options) {
  take_session(verb, arguments, options);
  add_fail_on_loss(verb, arguments);
  // The counters of a launcher that was killed, whose guardian runs this command. They are removed afterwards.
  verb.add_option("--event-counters", arguments.request.config.event_counters)->group("");
  verb.add_option("--created-since", options.created_since,
                  "leave the session as it is when it was created before (seconds since 1970)")
      ->option_text("TIME");
}

void take_stored(CLI::App& verb, SessionArguments& arguments, TraceOptions& options) {
  verb.add_option("session_name", arguments.session_name, "name of the session")
      ->required()
      ->check(is_name)
      ->option_text("NAME");
  verb.add_option("-p,--path", options.directory, "directory of the file NAME.lttng (default: LTTng's own)")
      ->option_text("DIR");
}

void take_status(CLI::App& verb, SessionArguments& arguments, TraceOptions& /*options*/) {
  verb.add_option("session_name", arguments.session_name, "name of the session (default: all)")->option_text("NAME");
}

void take_calibrate(CLI::App& verb, SessionArguments& arguments, TraceOptions& /*options*/) {
  add_names(verb, "-c,--context", arguments.request.config.context_fields_ust, "FIELD",
            "context fields of the event (default: procname vpid vtid)");
}

struct VerbRow {
  TraceVerb verb;  // run_verb() in trace_command.cpp runs it
  const char* name;
  const char* help;
  void (*take_options)(CLI::App& verb, SessionArguments& arguments, TraceOptions& options);  // null: none
  bool of_session;  // it acts on a session that exists
};

// In the order of the help. `launch trace read` is a program of its own, with a row in
// programs/launch/command_table.cpp.
constexpr VerbRow kVerbs[] = {
    {TraceVerb::kStart, "start", "configure and start a session, return at once", take_start, false},
    {TraceVerb::kStop, "stop", "stop recording and end the session", take_stop, true},
    {TraceVerb::kPause, "pause", "stop recording, keep the session", take_session, true},
    {TraceVerb::kResume, "resume", "record again after a pause", take_session, true},
    {TraceVerb::kRecordSnapshot, "record_snapshot", "write the events that a snapshot session holds", take_session,
     true},
    {TraceVerb::kSave, "save", "write the configuration of a session to a file", take_stored, true},
    {TraceVerb::kLoad, "load", "create a session from its saved configuration", take_stored, false},
    {TraceVerb::kList, "list", "print the sessions that exist", nullptr, false},
    {TraceVerb::kStatus, "status", "print channels, event rules and losses of sessions", take_status, true},
    {TraceVerb::kEvents, "events",
     "print what can be recorded now: events of running programs and of the kernel, context fields", nullptr, false},
    {TraceVerb::kCalibrate, "calibrate",
     "measure what recording an event costs on this machine, for the verdicts of sessions", take_calibrate, false},
};

void complete(TraceOptions& options, const SessionArguments& arguments) {
  TraceConfig& config = options.config = arguments.request.config;
  const bool all_sessions = options.verb == TraceVerb::kStatus && arguments.session_name.empty();
  config.session_name =
      arguments.session_name.empty() && !all_sessions ? "session" + session_timestamp() : arguments.session_name;
  config.base_path = trace_base_path(arguments.path, launch::own_environment());
  config.context_fields_kernel = config.context_fields_ust;
  options.dual_session = arguments.dual_session;
  // All verbs but record_snapshot act on the half that runs on demand.
  config.dual_runtime = arguments.dual_session && options.verb != TraceVerb::kRecordSnapshot;
  config.dual_session = arguments.dual_session && options.verb == TraceVerb::kRecordSnapshot;
}

}  // namespace

bool acts_on_session(std::string_view verb) {
  return std::any_of(std::begin(kVerbs), std::end(kVerbs),
                     [&](const VerbRow& row) { return row.of_session && row.name == verb; });
}

std::variant<TraceOptions, ParserMessage> parse_trace_options(const std::vector<std::string>& arguments) {
  TraceOptions options;
  SessionArguments session;
  CLI::App command("Record a trace of ROS 2 applications. Without a verb: interactively.", "launch trace");
  command.require_subcommand(0, 1);
  command
      .add_option("-s,--session-name", session.session_name, "name of the session (default: session-YYYYMMDDHHMMSS)")
      ->check(is_name)
      ->option_text("NAME");
  add_session_options(command, session, options);
  add_dual_session(command, session);
  add_fail_on_loss(command, session);

  for (const VerbRow& row : kVerbs) {
    CLI::App* const verb = command.add_subcommand(row.name, row.help);
    if (row.take_options != nullptr) {
      row.take_options(*verb, session, options);
    }
  }
  // Named here for the help.
  command.add_subcommand("read", "print the events of recorded traces, or count them (launch trace read --help)");

  try {
    command.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    const auto chosen = command.get_subcommands();
    return ParserMessage{0, chosen.empty() ? command.help() : chosen.front()->help("launch trace")};
  } catch (const CLI::ParseError& error) {
    return ParserMessage{launch::kWrongCommandLine, launch::usage_error_of(command, error)};
  }
  for (const VerbRow& row : kVerbs) {
    if (command.got_subcommand(row.name)) {
      options.verb = row.verb;
      options.command += std::string(" ") + row.name;
    }
  }
  complete(options, session);
  return options;
}

}  // namespace tracing
