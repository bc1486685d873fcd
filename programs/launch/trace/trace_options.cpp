// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/trace_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <type_traits>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"

namespace tracing {
namespace {

// As typed; the defaults that depend on the environment are not filled in yet.
struct SessionArguments {
  std::string session_name;
  std::string path;
  std::vector<std::string> context_fields = default_context_fields();
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

std::string not_negative(const std::string& number) {
  return number.starts_with('-') ? fmt::format("expected a number that is not negative, got '{}'", number) : "";
}

void add_buffer_options(CLI::App& command, TraceConfig& config) {
  const auto number = [&command](const std::string& option, auto& value, const std::string& unit,
                                 const std::string& help) {
    CLI::Option* const made = command.add_option(option, value, help)->option_text(unit);
    // The parser would take -5 for a huge number.
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_unsigned_v<Value> || std::is_same_v<Value, std::optional<std::uint32_t>>) {
      made->check(not_negative);
    }
  };
  number("--subbuffer-size-ust", config.subbuffer_size_ust, "BYTES", "size of a sub-buffer of the userspace channel");
  command.add_flag("--init-channel", config.init_channel,
                   "record initialisation events into a channel of their own, ros2_init");
  number("--subbuffer-count-ust", config.subbuffer_count_ust, "NUMBER",
         fmt::format("number of sub-buffers for each processor (default: {})", config.subbuffer_count_ust));
  number("--read-timer-ust", config.read_timer_ust, "MICROSECONDS",
         fmt::format("time between two reads of the buffers (default: {})", config.read_timer_ust));
  number("--switch-timer-ust", config.switch_timer_ust, "MICROSECONDS",
         fmt::format("time until a part-full sub-buffer is written (default: {}; 0 in snapshot mode)", kSwitchTimer));
  number("--subbuffer-size-kernel", config.subbuffer_size_kernel, "BYTES",
         "size of a sub-buffer of the kernel channel");
  command.add_option("--overwrite-ust", config.overwrite_ust,
                     "when buffers are full lose the oldest events, not the newest (default: in snapshot mode only)");
  number("--blocking-timeout-ust", config.blocking_timeout_ust, "MICROSECONDS",
         "time that a traced thread waits for room before it loses an event; -1: for ever; its process needs "
         "LTTNG_UST_ALLOW_BLOCKING=1 (default: 0)");
  command
      .add_option("--buffers-ust", config.buffers_ust,
                  "owner of the userspace buffers: uid (the user, default) or pid (each process)")
      ->transform(CLI::Transformer(
          std::map<std::string, BufferOwner>{{"uid", BufferOwner::kUser}, {"pid", BufferOwner::kProcess}}))
      ->option_text("OWNER");
  number("--tracefile-size", config.tracefile_size, "BYTES", "size at which a stream goes on in a further file");
  number("--tracefile-count", config.tracefile_count, "NUMBER", "files of a stream that are kept (default: all)");
}

void add_session_options(CLI::App& command, SessionArguments& arguments, TraceOptions& options) {
  TraceConfig& config = options.config;
  command
      .add_option("-p,--path", arguments.path,
                  "directory that will hold the trace directory (default: $ROS_TRACE_DIR, $ROS_HOME/tracing or "
                  "~/.ros/tracing)")
      ->option_text("DIR");
  add_names(command, "-u,--ust", config.events_ust, "EVENT", "userspace events (default: all ROS 2 events)");
  add_names(command, "-k,--kernel", config.events_kernel, "EVENT", "kernel events (default: none)");
  add_names(command, "--syscall", config.syscalls, "NAME", "system calls (default: none)");
  add_names(command, "-c,--context", arguments.context_fields, "FIELD",
            "context fields of every event (default: procname vpid vtid)");
  command.add_flag("-l,--list", options.list_names, "print the names of the enabled events and context fields");
  command.add_flag("-a,--append-trace", config.append_trace, "add to a trace directory that exists already");
  command.add_flag("--snapshot-mode", config.snapshot_mode, "keep the newest events in memory until record_snapshot");
  add_buffer_options(command, config);
  command.add_option("--url", config.url, "relay daemon that gets the trace: net://HOST[:CONTROL[:DATA]]")
      ->option_text("URL");
  command
      .add_option("--live-timer", config.live_timer,
                  "make the session live: viewers of the relay daemon get new events this often")
      ->option_text("MICROSECONDS");
}

void add_fail_on_loss(CLI::App& command, TraceOptions& options) {
  command.add_flag("--fail-on-loss", options.config.fail_on_loss, "exit with 1 when events were lost");
}

void add_dual_session(CLI::App& command, SessionArguments& arguments) {
  command.add_flag("-d,--dual-session", arguments.dual_session, "act on a dual session, whose snapshot half exists");
}

CLI::App* add_verb(CLI::App& command, const std::string& name, const std::string& help, SessionArguments& arguments) {
  CLI::App* verb = command.add_subcommand(name, help);
  verb->add_option("session_name", arguments.session_name, "name of the session")->required()->option_text("NAME");
  add_dual_session(*verb, arguments);
  return verb;
}

CLI::App* add_stored(CLI::App& command, const std::string& name, const std::string& help, SessionArguments& arguments,
                     TraceOptions& options) {
  CLI::App* verb = command.add_subcommand(name, help);
  verb->add_option("session_name", arguments.session_name, "name of the session")->required()->option_text("NAME");
  verb->add_option("-p,--path", options.directory, "directory of the file NAME.lttng (default: LTTng's own)")
      ->option_text("DIR");
  return verb;
}

CLI::App* add_status(CLI::App& command, SessionArguments& arguments) {
  CLI::App* verb = command.add_subcommand("status", "print channels, event rules and losses of sessions");
  verb->add_option("session_name", arguments.session_name, "name of the session (default: all)")->option_text("NAME");
  return verb;
}

CLI::App* add_calibrate(CLI::App& command, SessionArguments& arguments) {
  CLI::App* verb = command.add_subcommand(
      "calibrate", "measure what recording an event costs on this machine, for the verdicts of sessions");
  add_names(*verb, "-c,--context", arguments.context_fields, "FIELD",
            "context fields of the event (default: procname vpid vtid)");
  return verb;
}

void complete(TraceOptions& options, const SessionArguments& arguments) {
  TraceConfig& config = options.config;
  const bool all_sessions = options.verb == TraceVerb::kStatus && arguments.session_name.empty();
  config.session_name =
      arguments.session_name.empty() && !all_sessions ? "session" + session_timestamp() : arguments.session_name;
  config.base_path = trace_base_path(arguments.path, launch::own_environment());
  config.context_fields_ust = arguments.context_fields;
  config.context_fields_kernel = arguments.context_fields;
  options.dual_session = arguments.dual_session;
  // All verbs but record_snapshot act on the half that runs on demand.
  config.dual_runtime = arguments.dual_session && options.verb != TraceVerb::kRecordSnapshot;
  config.dual_session = arguments.dual_session && options.verb == TraceVerb::kRecordSnapshot;
}

}  // namespace

std::variant<TraceOptions, ParserMessage> parse_trace_options(const std::vector<std::string>& arguments) {
  TraceOptions options;
  SessionArguments session;
  CLI::App command("Record a trace of ROS 2 applications. Without a verb: interactively.", "launch trace");
  command.require_subcommand(0, 1);
  command
      .add_option("-s,--session-name", session.session_name, "name of the session (default: session-YYYYMMDDHHMMSS)")
      ->option_text("NAME");
  add_session_options(command, session, options);
  add_dual_session(command, session);
  add_fail_on_loss(command, options);

  CLI::App* start = add_verb(command, "start", "configure and start a session, return at once", session);
  add_session_options(*start, session, options);
  CLI::App* stop = add_verb(command, "stop", "stop recording and end the session", session);
  add_fail_on_loss(*stop, options);
  // The counters of a launcher that was killed, whose guardian runs this command. They are removed afterwards.
  stop->add_option("--event-counters", options.config.event_counters)->group("");
  stop->add_option("--created-since", options.created_since,
                   "leave the session as it is when it was created before (seconds since 1970)")
      ->option_text("TIME");
  const std::map<CLI::App*, TraceVerb> verbs = {
      {start, TraceVerb::kStart},
      {add_verb(command, "pause", "stop recording, keep the session", session), TraceVerb::kPause},
      {add_verb(command, "resume", "record again after a pause", session), TraceVerb::kResume},
      {stop, TraceVerb::kStop},
      {add_verb(command, "record_snapshot", "write the events that a snapshot session holds", session),
       TraceVerb::kRecordSnapshot},
      {add_stored(command, "save", "write the configuration of a session to a file", session, options),
       TraceVerb::kSave},
      {add_stored(command, "load", "create a session from its saved configuration", session, options),
       TraceVerb::kLoad},
      {command.add_subcommand("list", "print the sessions that exist"), TraceVerb::kList},
      {add_status(command, session), TraceVerb::kStatus},
      {command.add_subcommand("events",
                              "print what can be recorded now: events of running programs and of the kernel, "
                              "context fields"),
       TraceVerb::kEvents},
      {add_calibrate(command, session), TraceVerb::kCalibrate},
  };

  // A program of its own, which main() executes; named here for the help.
  command.add_subcommand("read", "print the events of recorded traces, or count them (launch trace read --help)");

  try {
    command.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    const auto chosen = command.get_subcommands();
    return ParserMessage{0, chosen.empty() ? command.help() : chosen.front()->help("launch trace")};
  } catch (const CLI::ParseError& error) {
    return ParserMessage{launch::kWrongCommandLine, launch::usage_error_of(command, error)};
  }
  for (const auto& [verb, value] : verbs) {
    if (!verb->parsed()) {
      continue;
    }
    options.verb = value;
    options.command += " " + verb->get_name();
  }
  complete(options, session);
  return options;
}

}  // namespace tracing
