// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/trace_command.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <optional>

#include "base/diagnostics/command_error.hpp"
#include "launcher/traced/snapshot_socket.hpp"
#include "programs/launch/trace/session_end.hpp"
#include "programs/launch/trace/session_text.hpp"
#include "programs/launch/trace/trace_options.hpp"
#include "tracing/record/account/cost_measurement.hpp"
#include "tracing/record/account/counters/counter_directory.hpp"
#include "tracing/record/account/event_cost.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/lttng/daemons_kept_going.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/session_store.hpp"

namespace tracing {
namespace {

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kNoLttng = 2;  // as ros2 trace

// Lines that nobody can read any more are no error (fmt::print would throw).
void print_line(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void print_error(const TraceOptions& options, const TraceError& error) {
  fmt::print(stderr, "{}", launch::command_error(options.command, error.what(), error.remedy()));
}

void print_names(const std::string& heading, const std::vector<std::string>& names, bool list) {
  print_line(heading);
  if (!list) {
    return;
  }
  for (const std::string& name : names) {
    print_line("\t" + name);
  }
}

void print_events(const std::string& what, const std::string& unit, const std::vector<std::string>& names, bool list) {
  print_names(names.empty() ? fmt::format("{} tracing disabled", what)
                            : fmt::format("{} tracing enabled ({} {})", what, names.size(), unit),
              names, list);
}

TraceConfig snapshot_half(TraceConfig config) {
  config.dual_runtime = false;
  config.dual_session = true;
  return config;
}

void print_session(const TraceOptions& options) {
  const TraceConfig& config = options.config;
  print_events("userspace", "events", config.events_ust, options.list_names);
  print_events("kernel", "events", config.events_kernel, options.list_names);
  print_events("syscalls", "syscalls", config.syscalls, options.list_names);
  print_names(fmt::format("context ({} fields)", config.context_fields_ust.size()), config.context_fields_ust,
              options.list_names);
  if (options.dual_session) {
    print_line("writing snapshot tracing session to: " + snapshot_half(config).trace_directory());
    print_line("writing runtime tracing session to: " + config.trace_directory());
  } else {
    print_line("writing tracing session to: " + config.destination());
  }
}

// A dual session's runtime half starts where the snapshot of its initialisation events was taken.
void start(const TraceOptions& options, Tracer& tracer) {
  if (options.dual_session) {
    tracer.record_snapshot(snapshot_half(options.config).lttng_session_name());
  }
  SetupReport report = tracer.start(options.config);
  for (std::string& warning : tracer.unreachable_processes()) {
    report.warnings.push_back(std::move(warning));
  }
  for (const std::string& warning : report.warnings) {
    fmt::print(stderr, "{}: warning: {}\n", options.command, warning);
  }
  if (!report.notes.empty()) {
    fmt::print(stderr, "{}: note: {}\n", options.command, report.notes);
  }
}

void print_account(const TraceOptions& options, const LossAccount& losses) {
  if (!losses.directory.empty()) {
    print_line(losses.wrote_nothing ? "no trace was written" : "trace written to: " + losses.directory);
  }
  print_line(fmt::format("trace is {}: {}", describe_completeness(losses), describe_losses(losses)));
  if (const std::string cost = describe_cost(losses); !cost.empty()) {
    print_line(cost);
  }
  for (const std::string& note : losses.notes) {
    fmt::print(stderr, "{}: note: {}\n", options.command, note);
  }
  if (!losses.unwritten_verdict.empty()) {
    fmt::print(stderr, "{}: warning: {}\n", options.command, losses.unwritten_verdict);
  }
}

// A session of a launch on several machines is asked of the launch, which has all of them take one.
void record_snapshot(const TraceOptions& options, Tracer& tracer) {
  const std::string session_name = options.config.lttng_session_name();
  if (const std::optional<launch::SnapshotAnswer> taken = launch::ask_for_snapshot(session_name)) {
    if (!taken->error.empty()) {
      throw TraceError(taken->error);
    }
    print_line("snapshot written to: " + taken->directory);
    if (!taken->complete) {
      fmt::print(stderr, "{}: warning: the snapshot is incomplete, see {}/{}\n", options.command, taken->directory,
                 kVerdictFile);
    }
    return;
  }
  const std::string directory = tracer.record_snapshot(session_name);
  if (!directory.empty()) {
    print_line("snapshot written to: " + directory);
  }
}

void finish(const TraceOptions& options, Tracer& tracer, const std::function<bool()>& give_up) {
  const TraceConfig& config = options.config;
  print_line("stopping & destroying tracing session");
  const LossAccount losses = tracer.finish(config, give_up);
  if (losses.of_snapshots) {
    print_line(losses.directory.empty() ? "the session has ended"
               : losses.wrote_nothing   ? "no trace was written: no snapshot was taken"
                                        : "snapshots are in: " + losses.directory);
    return;
  }
  print_account(options, losses);
  if (config.fail_on_loss && losses.has_losses()) {
    throw TraceError(fmt::format("the trace of session '{}' is incomplete", config.lttng_session_name()),
                     "use larger buffers, record fewer events, or leave out --fail-on-loss");
  }
}

// A session that existed before a launch, or a command, is not theirs. A session daemon that is stopped does not tell
// how old a session is, so whoever asks at the end of one keeps it going (DaemonsKeptGoing).
bool is_older(const std::string& session_name, std::int64_t seconds, Tracer& tracer) {
  const std::vector<SessionSummary> sessions = tracer.sessions();
  return std::any_of(sessions.begin(), sessions.end(), [&](const SessionSummary& session) {
    return session.name == session_name && session.created < seconds;
  });
}

// Says which daemons it has continued.
bool is_older_with_notes(const TraceOptions& options, Tracer& tracer) {
  const DaemonsKeptGoing daemons;
  const bool older = is_older(options.config.lttng_session_name(), *options.created_since, tracer);
  for (const std::string& note : daemons.notes()) {
    fmt::print(stderr, "{}: note: {}\n", options.command, note);
  }
  return older;
}

// Ends the session of this command, from another process.
std::function<void()> ending(const TraceConfig& config, Tracer& tracer) {
  return [&config, &tracer, begin = std::time(nullptr)] {
    const DaemonsKeptGoing daemons;
    if (!is_older(config.lttng_session_name(), begin, tracer)) {
      tracer.finish(config, [] { return false; });
    }
  };
}

// What ends the command in the middle, a signal or kill -9, ends the new session with it.
void start_or_leave_nothing(const TraceOptions& options, Tracer& tracer) {
  const SessionGuard guard(ending(options.config, tracer));
  EnterOrSignal signals;
  start(options, tracer);
  if (!signals.take_signal()) {
    return;
  }
  tracer.finish(options.config, [] { return true; });
  throw TraceError(fmt::format("interrupted: session '{}' was ended again", options.config.lttng_session_name()));
}

EnterOrSignal::Answer ask(const std::string& prompt, EnterOrSignal& input) {
  fmt::print("{}", prompt);
  std::fflush(stdout);
  const EnterOrSignal::Answer answer = input.wait();
  // A user who types Enter at a terminal has made the line break already.
  if (answer != EnterOrSignal::Answer::kEnter || isatty(STDIN_FILENO) == 0) {
    print_line("");
  }
  return answer;
}

void run_interactively(const TraceOptions& options, Tracer& tracer) {
  EnterOrSignal input;
  print_session(options);
  switch (ask(options.dual_session ? "press enter to start tracing..." : "press enter to start...", input)) {
    case EnterOrSignal::Answer::kSignal:
      return;  // nothing exists yet
    case EnterOrSignal::Answer::kInputEnded:
      throw TraceError("the input ended before tracing was started",
                       "without a terminal use `launch trace start NAME`");
    case EnterOrSignal::Answer::kEnter:
      break;
  }
  const SessionGuard guard(ending(options.config, tracer));
  start(options, tracer);
  ask("press enter to stop...", input);  // whatever the answer is, it ends the session
  finish(options, tracer, [&input] { return input.take_signal(); });
}

void print_status(const std::string& session_name, Tracer& tracer) {
  if (!session_name.empty()) {
    fmt::print("{}", session_as_text(tracer.status(session_name)));
    return;
  }
  const std::vector<SessionSummary> sessions = tracer.sessions();
  if (sessions.empty()) {
    fmt::print("{}", sessions_as_text(sessions));
  }
  for (const SessionSummary& session : sessions) {
    fmt::print("{}", session_as_text(tracer.status(session.name)));
  }
}

void print_calibration(const std::vector<std::string>& context_fields) {
  const EventCost cost = calibrate(context_fields);
  remember(cost);
  const std::string fields = context_fields.empty() ? "" : fmt::format(" with {}", fmt::join(cost.context_fields, " "));
  fmt::print("an event{} costs {:.1f} ns on {}, LTTng {}\nkept in {}\n", fields, cost.ns_per_event, cost.cpu,
             cost.lttng, event_cost_file().string());
}

void run_verb(const TraceOptions& options, Tracer& tracer) {
  const std::string session_name = options.config.lttng_session_name();
  switch (options.verb) {
    case TraceVerb::kInteractive:
      return run_interactively(options, tracer);
    case TraceVerb::kStart:
      print_session(options);
      return start_or_leave_nothing(options, tracer);
    case TraceVerb::kPause:
      print_line("pausing tracing session");
      if (const std::optional<LossAccount> losses = tracer.pause(session_name)) {
        print_account(options, *losses);
      }
      return;
    case TraceVerb::kResume:
      print_line("resuming tracing session");
      if (options.dual_session) {
        tracer.record_snapshot(snapshot_half(options.config).lttng_session_name());
      }
      return tracer.resume(session_name);
    case TraceVerb::kStop: {
      std::optional<CounterDirectory> counters;
      if (!options.config.event_counters.empty()) {
        counters.emplace(options.config.event_counters);
      }
      if (options.created_since && is_older_with_notes(options, tracer)) {
        print_line(fmt::format("trace session '{}' is left as it is: it is older", session_name));
        return;
      }
      EnterOrSignal signals;
      return finish(options, tracer, [&signals] { return signals.take_signal(); });
    }
    case TraceVerb::kList:
      fmt::print("{}", sessions_as_text(tracer.sessions()));
      return;
    case TraceVerb::kStatus:
      return print_status(options.config.session_name, tracer);
    case TraceVerb::kEvents:
      fmt::print("{}", events_as_text(tracer.traceable_events()));
      return;
    case TraceVerb::kCalibrate:
      return print_calibration(options.config.context_fields_ust);
    case TraceVerb::kSave:
      tracer.save(session_name, options.directory);
      return print_line("saved to: " + file_of_saved_session(session_name, options.directory));
    case TraceVerb::kLoad:
      return tracer.load(session_name, options.directory);
    case TraceVerb::kRecordSnapshot:
      print_line("recording snapshot of tracing session");
      return record_snapshot(options, tracer);
  }
}

}  // namespace

int run_trace_command(const std::vector<std::string>& arguments) {
  return run_trace_command(arguments, *make_lttng_tracer());
}

int run_trace_command(const std::vector<std::string>& arguments, Tracer& tracer) {
  const auto parsed = parse_trace_options(arguments);
  if (const auto* message = std::get_if<ParserMessage>(&parsed)) {
    if (message->exit_code == kSuccess) {
      fmt::print("{}", message->text);
    } else {
      fmt::print(stderr, "{}", message->text);
    }
    return message->exit_code;
  }
  // Who reads the output may go at any time, which is no reason to leave a session half made.
  std::signal(SIGPIPE, SIG_IGN);
  const auto& options = std::get<TraceOptions>(parsed);
  try {
    run_verb(options, tracer);
    return kSuccess;
  } catch (const SessionDaemonMissing& error) {
    print_error(options, error);
    return kNoLttng;
  } catch (const TraceError& error) {
    print_error(options, error);
    return kFailure;
  }
}

}  // namespace tracing
