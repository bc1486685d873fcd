// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <charconv>

#include "actions/trace/event_rules.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/plan/event_classes.hpp"

namespace launch {

namespace {

using Config = tracing::TraceConfig;
using Type = AttributeType;

// An attribute that ros2 launch does not know.
AttributeSpec extension(const char* name, Type type, const std::string& fallback, const char* help) {
  return {name, type, false, fallback, help, true};
}

// The place of a member of the trace, or of what the launcher does with it.
template <typename Member>
auto at(Member Config::*member) {
  return place_of(&TraceRequest::config, member);
}
template <typename Member>
auto at(Member tracing::ChannelBuffers::*member) {
  return [member](TraceRequest& request) -> SettingPlace { return &(request.config.ust.*member); };
}
template <typename Member, typename Struct>
auto of_choices(Member Struct::*member) {
  return place_of(&TraceRequest::choices, member);
}

void perform_session_name(const Fields& fields, Scope& scope, TraceRequest& request) {
  const Template& text = fields.text("session-name");
  request.config.session_name = text.perform(scope);
  if (request.config.session_name.empty()) {
    throw LaunchError("the session name is empty", text.where(), "the directory of the trace is called so, too");
  }
  if (request.config.session_name.find('/') != std::string::npos) {
    throw LaunchError(fmt::format("the session name '{}' has a slash", request.config.session_name), text.where(),
                      "name the directory with base-path");
  }
}

SettingPlace buffer_owner(TraceRequest& request) {
  return SettingChoice{
      {"uid", "pid"}, static_cast<std::size_t>(request.config.buffers_ust), [&request](std::size_t word) {
        request.config.buffers_ust = static_cast<tracing::BufferOwner>(word);
      }};
}

SettingPlace buffer_sizes(TraceRequest& request) {
  return SettingChoice{{"auto", "fixed"}, request.choices.auto_buffers ? 0U : 1U, [&request](std::size_t word) {
                         request.choices.auto_buffers = word == 0;
                       }};
}

SettingPlace snapshot_signal(TraceRequest& request) {
  return SettingChoice{
      {"SIGUSR1", "SIGUSR2"}, request.choices.snapshot_on_signal == SIGUSR2 ? 1U : 0U, [&request](std::size_t word) {
        request.choices.snapshot_on_signal = word == 0 ? SIGUSR1 : SIGUSR2;
      }};
}

void perform_snapshot_limit(const Fields& fields, Scope& scope, TraceRequest& request) {
  NumberField limit = *fields.number("snapshot-limit");
  limit.require_not_negative();
  request.config.snapshot_limit = static_cast<std::uint64_t>(limit.perform(scope));
  if (request.config.snapshot_limit == 0) {
    throw LaunchError("snapshot-limit is at least 1, got 0", fields.where("snapshot-limit"));
  }
}

// In milliseconds.
template <typename Member>
auto perform_deadline(const char* attribute, Member deadline) {
  return [attribute, deadline](const Fields& fields, Scope& scope, TraceRequest& request) {
    const double milliseconds = fields.number(attribute)->perform(scope);
    if (!(milliseconds > 0)) {
      throw LaunchError(fmt::format("{} is a number of milliseconds above 0, got {}", attribute, milliseconds),
                        fields.where(attribute));
    }
    request.choices.*deadline = milliseconds;
  };
}

void perform_snapshot_size(const Fields& fields, Scope& scope, TraceRequest& request) {
  NumberField size = *fields.number("snapshot-size");
  size.require_not_negative();
  request.config.snapshot_size = static_cast<std::uint64_t>(size.perform(scope));
  if (request.config.snapshot_size == 0) {
    throw LaunchError("snapshot-size is at least 1, got 0", fields.where("snapshot-size"));
  }
}

SettingPlace tracetools_mode(TraceRequest& request) {
  return SettingChoice{
      {"auto", "own", "theirs"}, static_cast<std::size_t>(request.choices.tracetools), [&request](std::size_t word) {
        request.choices.tracetools = static_cast<TracetoolsMode>(word);
      }};
}

// Reads "2%" as 0.02.
double perform_percentage(const Template& text, Scope& scope) {
  const std::string given = text.perform(scope);
  double percent = 0;
  const char* const end = given.data() + given.size();
  const auto read = std::from_chars(given.data(), end, percent);
  if (read.ec != std::errc() || std::string_view(read.ptr, end) != "%" || !(percent > 0)) {
    throw LaunchError(
        fmt::format("max-overhead is expected to be a percentage of a processor like 2%, got '{}'", given),
        text.where());
  }
  return percent / 100;
}

// An entry is a class of events, or a pattern with its provider.
void check_drop_order(const std::vector<std::string>& order, const SourceRange& where) {
  const std::vector<std::string>& known = tracing::droppable_classes();
  for (const std::string& name : order) {
    if (name.find(':') == std::string::npos && std::find(known.begin(), known.end(), name) == known.end()) {
      throw LaunchError(fmt::format("there is no class of events '{}'", name), where,
                        fmt::format("drop-order takes {}, or events as PROVIDER:NAME", fmt::join(known, ", ")));
    }
  }
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& parts) {
  std::vector<std::string> names;
  for (const Named& part : parts) {
    names.push_back(part.name);
  }
  return names;
}

std::vector<Setting<TraceRequest>> make_trace_settings() {
  const Config defaults;
  return {
      {.attribute = {"session-name", Type::kText, true, "", "name of the session and of the trace's directory"},
       .place = at(&Config::session_name),
       .perform = perform_session_name,
       .shown = "session-name"},
      {.attribute = {"append-timestamp", Type::kBoolean, false, "false",
                     "append -YYYYMMDDHHMMSS to the name, and -2, -3, … if another launch has it"},
       .perform =
           [](const Fields& fields, Scope& scope, TraceRequest& request) {
             if (fields.boolean("append-timestamp", false).perform(scope)) {
               request.config.session_name += tracing::session_timestamp();
               request.config.has_timestamp = true;
             }
           }},
      {.attribute = {"base-path", Type::kText, false, "$ROS_TRACE_DIR, $ROS_HOME/tracing or ~/.ros/tracing",
                     "directory that will hold the trace's directory"},
       .place = at(&Config::base_path),
       .shown = "trace-directory",
       .show = [](const TraceRequest& request) { return request.config.trace_directory(); }},
      {.attribute = {"append-trace", Type::kBoolean, false, "false", "allow a trace directory that exists"},
       .place = at(&Config::append_trace),
       .shown = "append-trace",
       .option = {"-a,--append-trace", "", "add to a trace directory that exists already"}},
      {.attribute = extension("fail-on-loss", Type::kBoolean, "false", "exit with 1 when events were lost"),
       .place = at(&Config::fail_on_loss),
       .shown = "fail-on-loss"},
      {.attribute = extension("report", Type::kBoolean, "false",
                              "make a page of the trace at its end, report.html in its directory"),
       .place = of_choices(&TraceChoices::report),
       .shown = "report"},
      {.attribute = {"events-ust", Type::kWords, false, "all events of provider ros2",
                     "userspace events; * matches any text; `'ros2:* except ros2:rcl_init level INFO if vpid > 1'` in "
                     "quotes"},
       .place = at(&Config::events_ust),
       .perform = event_rules<TraceRequest>("events-ust", Tracepoints::kUserspace, at(&Config::events_ust)),
       .shown = "events-ust",
       .option = {"-u,--ust", "EVENT", "userspace events (default: all ROS 2 events)"}},
      {.attribute =
           extension("events-python", Type::kWords, "none",
                     "loggers of Python programs that import lttngust; `my_logger:*` is one with all below it"),
       .place = at(&Config::events_python),
       .perform = event_rules<TraceRequest>("events-python", Tracepoints::kKernel, at(&Config::events_python)),
       .shown = "events-python",
       .option = {"--python", "LOGGER", "loggers of Python programs that import lttngust (default: none)"}},
      {.attribute = {"events-kernel", Type::kWords, false, "none", "kernel tracepoints"},
       .place = at(&Config::events_kernel),
       .perform = event_rules<TraceRequest>("events-kernel", Tracepoints::kKernel, at(&Config::events_kernel)),
       .shown = "events-kernel",
       .option = {"-k,--kernel", "EVENT", "kernel events (default: none)"}},
      {.attribute = {"syscalls", Type::kWords, false, "none", "system calls"},
       .place = at(&Config::syscalls),
       .shown = "syscalls",
       .option = {"--syscall", "NAME", "system calls (default: none)"}},
      {.shown = "channels", .show = [](const TraceRequest& request) { return names_of(request.config.channels); }},
      {.shown = "chains", .show = [](const TraceRequest& request) { return names_of(request.choices.chains); }},
      {.attribute = {"context-fields", Type::kWords, false, "procname vpid vtid", "fields added to every event"},
       .place = at(&Config::context_fields_ust),
       .shown = "context-fields",
       .option = {"-c,--context", "FIELD", "context fields of every event (default: procname vpid vtid)"}},
      {.attribute = extension("context-fields-kernel", Type::kWords, "as context-fields",
                              "fields added to every event of the kernel; context-fields is for userspace events then"),
       .place = at(&Config::context_fields_kernel),
       .shown = "context-fields-kernel"},
      {.attribute = extension("nodes", Type::kWords, "all",
                              "record these nodes and processes only, by name; * matches any text"),
       .perform = [](const Fields& fields, Scope& scope,
                     TraceRequest& request) { request.choices.nodes = perform_names(fields, "nodes", scope); }},
      {.attribute =
           extension("tracetools", Type::kText, "auto",
                     "of processes of another ROS 2: auto gives them ours where every call fits, own demands it, "
                     "theirs leaves them their own"),
       .place = tracetools_mode,
       .shown = "tracetools"},
      {.attribute =
           extension("python-nodes", Type::kBoolean, "false",
                     "give callbacks of Python nodes, those of rclpy, the events that callbacks of rclcpp have"),
       .place = of_choices(&TraceChoices::python_nodes),
       .shown = "python-nodes"},
      {.attribute = {"subbuffer-size-ust", Type::kInteger, false, fmt::format("{}", defaults.ust.subbuffer_size),
                     "bytes"},
       .place = at(&tracing::ChannelBuffers::subbuffer_size),
       .shown = "subbuffer-size-ust",
       .option = {"--subbuffer-size-ust", "BYTES", "size of a sub-buffer of the userspace channel"}},
      {.attribute = extension("subbuffers", Type::kText, "fixed",
                              "auto: derive subbuffer-size-ust from the number of processes and processors"),
       .place = buffer_sizes},
      {.attribute = extension("init-channel", Type::kBoolean, "false",
                              "record initialisation events into a channel of their own, ros2_init"),
       .place = at(&Config::init_channel),
       .shown = "init-channel",
       .option = {"--init-channel", "", "record initialisation events into a channel of their own, ros2_init"}},
      {.attribute = extension("subbuffer-count-ust", Type::kInteger, fmt::format("{}", defaults.ust.subbuffer_count),
                              "sub-buffers for each processor"),
       .place = at(&tracing::ChannelBuffers::subbuffer_count),
       .shown = "subbuffer-count-ust",
       .option = {"--subbuffer-count-ust", "NUMBER",
                  fmt::format("number of sub-buffers for each processor (default: {})", defaults.ust.subbuffer_count)}},
      {.attribute = extension("read-timer-ust", Type::kInteger, fmt::format("{}", defaults.ust.read_timer),
                              "microseconds between two reads of the buffers; 0: traced processes wake the reader"),
       .place = at(&tracing::ChannelBuffers::read_timer),
       .shown = "read-timer-ust",
       .option = {"--read-timer-ust", "MICROSECONDS",
                  fmt::format("time between two reads of the buffers (default: {})", defaults.ust.read_timer)}},
      {.attribute =
           extension("switch-timer-ust", Type::kInteger, fmt::format("{}; 0 in snapshot mode", tracing::kSwitchTimer),
                     "microseconds until a part-full sub-buffer is written; 0: never"),
       .place = at(&Config::switch_timer_ust),
       .shown = "switch-timer-ust",
       .show = [](const TraceRequest& request) { return std::int64_t{request.config.switch_timer()}; },
       .option = {"--switch-timer-ust", "MICROSECONDS",
                  fmt::format("time until a part-full sub-buffer is written (default: {}; 0 in snapshot mode)",
                              tracing::kSwitchTimer)}},
      {.attribute = extension("overwrite-ust", Type::kBoolean, "false; true in snapshot mode",
                              "when buffers are full lose the oldest events, not the newest"),
       .place = at(&Config::overwrite_ust),
       .shown = "overwrite-ust",
       .show =
           [](const TraceRequest& request) {
             return request.config.overwrite_ust.value_or(request.config.records_snapshots());
           },
       .option = {"--overwrite-ust", "BOOLEAN",
                  "when buffers are full lose the oldest events, not the newest (default: in snapshot mode only)"}},
      {.attribute = extension("blocking-timeout-ust", Type::kInteger, "0",
                              "microseconds that a traced thread waits for room before an event is lost; -1: for ever"),
       .place = at(&tracing::ChannelBuffers::blocking_timeout),
       .shown = "blocking-timeout-ust",
       .option = {"--blocking-timeout-ust", "MICROSECONDS",
                  "time that a traced thread waits for room before it loses an event; -1: for ever; its process needs "
                  "LTTNG_UST_ALLOW_BLOCKING=1 (default: 0)"}},
      {.attribute = extension("buffers-ust", Type::kText, "uid",
                              "uid: all processes of a user share buffers; pid: each process has its own"),
       .place = buffer_owner,
       .shown = "buffers-ust",
       .option = {"--buffers-ust", "OWNER",
                  "owner of the userspace buffers: uid (the user, default) or pid (each process)"}},
      {.attribute = extension("tracefile-size", Type::kInteger, "0",
                              "bytes after which a stream goes on in a further file; 0: one file"),
       .place = at(&Config::tracefile_size),
       .shown = "tracefile-size",
       .option = {"--tracefile-size", "BYTES", "size at which a stream goes on in a further file"}},
      {.attribute = extension("tracefile-count", Type::kInteger, "0", "files of a stream that are kept; 0: all"),
       .place = at(&Config::tracefile_count),
       .shown = "tracefile-count",
       .option = {"--tracefile-count", "NUMBER", "files of a stream that are kept (default: all)"}},
      {.attribute =
           extension("url", Type::kText, "", "a relay daemon that gets the trace: net://HOST[:CONTROL[:DATA]]"),
       .place = at(&Config::url),
       .shown = "url",
       .show =
           [](const TraceRequest& request) {
             return request.config.over_network() ? request.config.destination() : std::string();
           },
       .option = {"--url", "URL", "relay daemon that gets the trace: net://HOST[:CONTROL[:DATA]]"}},
      {.attribute = extension(
           "live-timer", Type::kInteger, "0",
           "microseconds between two deliveries to the viewers of a live session; 0: the session is not live"),
       .place = at(&Config::live_timer),
       .shown = "live-timer",
       .option = {"--live-timer", "MICROSECONDS",
                  "make the session live: viewers of the relay daemon get new events this often"}},
      {.attribute = extension("launch-events", Type::kBoolean, "true",
                              "record what the launcher does, too: the events of provider launch"),
       .place = at(&Config::launch_events),
       .shown = "launch-events"},
      {.attribute = {"subbuffer-size-kernel", Type::kInteger, false, fmt::format("{}", defaults.subbuffer_size_kernel),
                     "bytes"},
       .place = at(&Config::subbuffer_size_kernel),
       .shown = "subbuffer-size-kernel",
       .option = {"--subbuffer-size-kernel", "BYTES", "size of a sub-buffer of the kernel channel"}},
      {.attribute = {"snapshot-mode", Type::kBoolean, false, "false",
                     "keep the newest events in memory until recorded"},
       .place = at(&Config::snapshot_mode),
       .shown = "snapshot-mode",
       .option = {"--snapshot-mode", "", "keep the newest events in memory until record_snapshot"}},
      {.attribute =
           extension("snapshot-on-crash", Type::kBoolean, "false",
                     "take a snapshot when a process dies unexpectedly, of a signal or with an exit code; implies "
                     "snapshot-mode"),
       .place = of_choices(&TraceChoices::snapshot_on_crash),
       .shown = "snapshot-on-crash"},
      {.attribute = extension("snapshot-on-signal", Type::kText, "none",
                              "SIGUSR1 or SIGUSR2: take a snapshot when the launcher gets it; implies snapshot-mode"),
       .place = snapshot_signal},
      {.attribute =
           extension("snapshot-on-events", Type::kWords, "none",
                     "take a snapshot when a userspace event comes; written as in events-ust; implies snapshot-mode"),
       .place = of_choices(&TraceChoices::snapshot_on_events),
       .perform = event_rules<TraceRequest>("snapshot-on-events", Tracepoints::kUserspace,
                                            of_choices(&TraceChoices::snapshot_on_events)),
       .shown = "snapshot-on-events"},
      {.attribute = extension("snapshot-on-late-callback", Type::kFloat, "none",
                              "milliseconds: take a snapshot when a callback takes longer; implies snapshot-mode"),
       .place = of_choices(&TraceChoices::callback_deadline),
       .perform = perform_deadline("snapshot-on-late-callback", &TraceChoices::callback_deadline),
       .shown = "snapshot-on-late-callback"},
      {.attribute =
           extension("snapshot-on-late-message", Type::kFloat, "none",
                     "milliseconds: take a snapshot when a message is taken that was published longer before; implies "
                     "snapshot-mode"),
       .place = of_choices(&TraceChoices::message_deadline),
       .perform = perform_deadline("snapshot-on-late-message", &TraceChoices::message_deadline),
       .shown = "snapshot-on-late-message"},
      {.attribute = extension("snapshot-limit", Type::kInteger, "10", "snapshots that are kept, the newest ones"),
       .place = at(&Config::snapshot_limit),
       .perform = perform_snapshot_limit,
       .shown = "snapshot-limit"},
      {.attribute =
           extension("snapshot-size", Type::kInteger, "10 userspace sub-buffers", "bytes of a snapshot at most"),
       .place = at(&Config::snapshot_size),
       .perform = perform_snapshot_size},
      {.attribute = extension("max-overhead", Type::kText, "none",
                              "limit of what recording costs in all traced processes together, such as 2% of a "
                              "processor; above it classes of events are dropped"),
       .perform =
           [](const Fields& fields, Scope& scope, TraceRequest& request) {
             request.config.max_overhead = perform_percentage(fields.text("max-overhead"), scope);
             request.config.drop_order = tracing::droppable_classes();
           },
       .shown = "max-overhead",
       .show =
           [](const TraceRequest& request) {
             const double share = request.config.max_overhead;
             return share == 0 ? std::string() : fmt::format("{:g}%", 100 * share);
           }},
      {.attribute = extension("drop-order", Type::kWords, "executor buffers layers messages services callbacks",
                              "classes of events that max-overhead may drop, in this order; also events as "
                              "PROVIDER:NAME"),
       .place = at(&Config::drop_order),
       .perform =
           [](const Fields& fields, Scope& scope, TraceRequest& request) {
             if (!fields.has("max-overhead")) {
               throw LaunchError("drop-order is for max-overhead, which is not given", fields.where("drop-order"),
                                 "add max-overhead=\"2%\", or leave drop-order out", Finding::kMissingAttribute);
             }
             request.config.drop_order = perform_names(fields, "drop-order", scope);
             check_drop_order(request.config.drop_order, fields.where("drop-order"));
           },
       .shown = "drop-order"},
      {.attribute = {"dual-session", Type::kBoolean, false, "false", "be the snapshot half of a dual session"},
       .place = at(&Config::dual_session),
       .shown = "dual-session"},
  };
}

}  // namespace

const std::vector<Setting<TraceRequest>>& trace_settings() {
  static const std::vector<Setting<TraceRequest>> settings = make_trace_settings();
  return settings;
}

}  // namespace launch
