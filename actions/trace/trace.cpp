// SPDX-License-Identifier: Apache-2.0
// <trace session-name="…"/>: records the run. Takes effect before any process starts, wherever it stands in the file.
#include <fmt/format.h>
#include <signal.h>

#include "actions/trace/trace_chain.hpp"
#include "actions/trace/trace_channel.hpp"
#include "actions/trace/trace_findings.hpp"
#include "actions/trace/trace_overhead.hpp"
#include "actions/trace/trace_scope.hpp"
#include "base/environment/session_suffix.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"
#include "tracing/record/plan/event_classes.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/tracer.hpp"

namespace launch {

namespace {

class Trace : public Action {
 public:
  explicit Trace(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        session_name_(fields.text("session-name")),
        append_timestamp_(fields.boolean("append-timestamp", false)),
        base_path_(fields.optional_text("base-path")),
        append_trace_(fields.boolean("append-trace", false)),
        fail_on_loss_(fields.boolean("fail-on-loss", false)),
        events_ust_(fields, "events-ust"),
        events_kernel_(fields, "events-kernel"),
        syscalls_(fields, "syscalls"),
        context_fields_(fields, "context-fields"),
        context_fields_kernel_(fields, "context-fields-kernel"),
        nodes_(fields, "nodes"),
        subbuffers_(fields.optional_text("subbuffers")),
        subbuffer_size_ust_(count_field(fields, "subbuffer-size-ust")),
        subbuffer_size_kernel_(count_field(fields, "subbuffer-size-kernel")),
        init_channel_(fields.boolean("init-channel", false)),
        subbuffer_count_ust_(count_field(fields, "subbuffer-count-ust")),
        read_timer_ust_(count_field(fields, "read-timer-ust")),
        switch_timer_ust_(count_field(fields, "switch-timer-ust")),
        blocking_timeout_ust_(fields.number("blocking-timeout-ust")),
        buffers_ust_(fields.optional_text("buffers-ust")),
        tracefile_size_(count_field(fields, "tracefile-size")),
        tracefile_count_(count_field(fields, "tracefile-count")),
        url_(fields.optional_text("url")),
        live_timer_(count_field(fields, "live-timer")),
        launch_events_(fields.boolean("launch-events", true)),
        snapshot_mode_(fields.boolean("snapshot-mode", false)),
        snapshot_on_crash_(fields.boolean("snapshot-on-crash", false)),
        snapshot_on_signal_(fields.optional_text("snapshot-on-signal")),
        snapshot_on_events_(fields, "snapshot-on-events"),
        snapshot_on_late_callback_(count_field(fields, "snapshot-on-late-callback")),
        snapshot_on_late_message_(count_field(fields, "snapshot-on-late-message")),
        snapshot_limit_(count_field(fields, "snapshot-limit")),
        snapshot_size_(count_field(fields, "snapshot-size")),
        max_overhead_(fields.optional_text("max-overhead")),
        drop_order_(fields, "drop-order"),
        dual_session_(fields.boolean("dual-session", false)) {
    if (fields.has("report")) {
      report_ = fields.boolean("report", false);
    }
    if (fields.has("overwrite-ust")) {
      overwrite_ust_ = fields.boolean("overwrite-ust", false);
    }
    for (const Fields* channel : fields.items("channel")) {
      channels_.emplace_back(*channel);
    }
    for (const Fields* chain : fields.items("chain")) {
      chains_.emplace_back(*chain);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    tracing::TraceConfig config;
    perform_session(config, scope);
    perform_events(config, scope);
    perform_buffers(config, scope);
    perform_overhead(config, scope);
    find_faults(config, context);
    TraceChoices choices = perform_choices(scope);
    config.snapshot_mode = config.snapshot_mode || choices.flight_recorder();
    context.requests().scopes.push_back(std::make_unique<TraceScope>(
        std::move(config), tracing::make_lttng_tracer(), context.own_prefix(), where(), std::move(choices)));
  }

 private:
  void find_faults(const tracing::TraceConfig& config, LaunchContext& context) const {
    if (events_ust_.given()) {
      find_unknown_events(config.events_ust, events_ust_.where(), context);
    }
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const tracing::ChannelConfig& channel = config.channels[i];
      find_unknown_events(channel.events_ust, channels_[i].events_where(), context);
      if (channel.context_fields) {
        find_unknown_context_fields(*channel.context_fields,
                                    channel.events_ust.empty() ? LTTNG_DOMAIN_KERNEL : LTTNG_DOMAIN_UST,
                                    channels_[i].context_where(), context);
      }
    }
    if (context_fields_.given() && !config.events_ust.empty()) {
      find_unknown_context_fields(config.context_fields_ust, LTTNG_DOMAIN_UST, context_fields_.where(), context);
    }
    if (context_fields_kernel_.given() && !(config.events_kernel.empty() && config.syscalls.empty())) {
      find_unknown_context_fields(config.context_fields_kernel, LTTNG_DOMAIN_KERNEL, context_fields_kernel_.where(),
                                  context);
    }
  }

  void perform_session(tracing::TraceConfig& config, Scope& scope) const {
    config.session_name = session_name_.perform(scope);
    if (config.session_name.empty()) {
      throw LaunchError("the session name is empty", session_name_.where(),
                        "the directory of the trace is called so, too");
    }
    if (config.session_name.find('/') != std::string::npos) {
      throw LaunchError(fmt::format("the session name '{}' has a slash", config.session_name), session_name_.where(),
                        "name the directory with base-path");
    }
    if (append_timestamp_.perform(scope)) {
      config.session_name += tracing::session_timestamp();
    }
    if (const auto suffix = scope.environment.find(kSessionSuffixVariable); suffix != scope.environment.end()) {
      config.session_name += suffix->second;
    }
    config.base_path =
        tracing::trace_base_path(base_path_ ? base_path_->perform(scope) : std::string(), scope.environment);
    config.append_trace = append_trace_.perform(scope);
    config.fail_on_loss = fail_on_loss_.perform(scope);
    config.snapshot_mode = snapshot_mode_.perform(scope);
    config.dual_session = dual_session_.perform(scope);
    if (url_) {
      config.url = url_->perform(scope);
    }
    if (live_timer_) {
      config.live_timer = microseconds(*live_timer_, scope);
    }
  }

  void perform_events(tracing::TraceConfig& config, Scope& scope) const {
    if (config.dual_session) {
      config.events_ust = tracing::initialisation_ros_events();
    }
    if (events_ust_.given()) {
      config.events_ust = events_ust_.perform_events(scope, Tracepoints::kUserspace);
    }
    config.launch_events = launch_events_.perform(scope);
    config.events_kernel = events_kernel_.perform_events(scope, Tracepoints::kKernel);
    config.syscalls = syscalls_.perform(scope);
    if (context_fields_.given()) {
      config.context_fields_ust = context_fields_.perform(scope);
    }
    config.context_fields_kernel =
        context_fields_kernel_.given() ? context_fields_kernel_.perform(scope) : config.context_fields_ust;
    for (const ChannelFields& channel : channels_) {
      config.channels.push_back(channel.perform(scope));
    }
  }

  void perform_overhead(tracing::TraceConfig& config, Scope& scope) const {
    if (!max_overhead_) {
      return;
    }
    config.max_overhead = perform_percentage(*max_overhead_, scope);
    config.drop_order = tracing::droppable_classes();
    if (drop_order_.given()) {
      config.drop_order = drop_order_.perform(scope);
      check_drop_order(config.drop_order, drop_order_.where());
    }
  }

  TraceChoices perform_choices(Scope& scope) const {
    TraceChoices choices;
    const auto asked = scope.environment.find("LAUNCH_TRACE_REPORT");  // launch --report
    choices.report = report_ ? report_->perform(scope) : asked != scope.environment.end() && asked->second == "1";
    if (report_ && choices.report && url_) {
      throw LaunchError("report needs the trace on this machine, but url sends it to a relay daemon", url_->where(),
                        "leave out report, and use launch report where the trace is");
    }
    choices.chains = perform_chains(chains_, scope);
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      const tracing::ChainDefinition& chain = choices.chains[i];
      for (const std::string& node : chain.nodes) {
        choices.chain_nodes.push_back({node, fmt::format("chain '{}'", chain.name), chains_[i].nodes_where()});
      }
    }
    if (!choices.chains.empty() && url_) {
      throw LaunchError("chains need the trace on this machine, but url sends it to a relay daemon", url_->where(),
                        "leave out the chains, and write chains.json where the trace is (docs/report.md)");
    }
    if (nodes_.given()) {
      choices.nodes = nodes_.perform(scope);
    }
    if (subbuffers_) {
      const std::string kind = subbuffers_->perform(scope);
      if (kind != "auto" && kind != "fixed") {
        throw LaunchError(fmt::format("subbuffers is expected to be auto or fixed, got '{}'", kind),
                          subbuffers_->where());
      }
      choices.auto_buffers = kind == "auto";
    }
    choices.snapshot_on_crash = snapshot_on_crash_.perform(scope);
    choices.snapshot_on_events = snapshot_on_events_.perform_events(scope, Tracepoints::kUserspace);
    if (snapshot_on_late_callback_) {
      choices.callback_deadline = snapshot_on_late_callback_->perform(scope);
    }
    if (snapshot_on_late_message_) {
      choices.message_deadline = snapshot_on_late_message_->perform(scope);
    }
    if (snapshot_on_signal_) {
      const std::string name = snapshot_on_signal_->perform(scope);
      if (name != "SIGUSR1" && name != "SIGUSR2") {
        throw LaunchError(fmt::format("snapshot-on-signal is expected to be SIGUSR1 or SIGUSR2, got '{}'", name),
                          snapshot_on_signal_->where());
      }
      choices.snapshot_on_signal = name == "SIGUSR1" ? SIGUSR1 : SIGUSR2;
    }
    return choices;
  }

  void perform_buffers(tracing::TraceConfig& config, Scope& scope) const {
    const auto replace_count = [&scope](std::uint64_t& value, const std::optional<NumberField>& given) {
      if (given) {
        value = count(*given, scope);
      }
    };
    const auto replace_time = [&scope](std::uint32_t& value, const std::optional<NumberField>& given) {
      if (given) {
        value = microseconds(*given, scope);
      }
    };
    replace_count(config.subbuffer_size_ust, subbuffer_size_ust_);
    replace_count(config.subbuffer_size_kernel, subbuffer_size_kernel_);
    replace_count(config.subbuffer_count_ust, subbuffer_count_ust_);
    replace_time(config.read_timer_ust, read_timer_ust_);
    if (switch_timer_ust_) {
      config.switch_timer_ust = microseconds(*switch_timer_ust_, scope);
    }
    replace_count(config.snapshot_size, snapshot_size_);
    replace_count(config.snapshot_limit, snapshot_limit_);
    replace_count(config.tracefile_size, tracefile_size_);
    replace_count(config.tracefile_count, tracefile_count_);
    config.init_channel = init_channel_.perform(scope);
    if (overwrite_ust_) {
      config.overwrite_ust = overwrite_ust_->perform(scope);
    }
    if (blocking_timeout_ust_) {
      config.blocking_timeout_ust = static_cast<std::int64_t>(blocking_timeout_ust_->perform(scope));
    }
    if (buffers_ust_) {
      const std::string owner = buffers_ust_->perform(scope);
      if (owner != "uid" && owner != "pid") {
        throw LaunchError(fmt::format("buffers-ust is expected to be uid or pid, got '{}'", owner),
                          buffers_ust_->where());
      }
      config.buffers_ust = owner == "pid" ? tracing::BufferOwner::kProcess : tracing::BufferOwner::kUser;
    }
  }

  Template session_name_;
  BooleanField append_timestamp_;
  std::optional<Template> base_path_;
  BooleanField append_trace_;
  BooleanField fail_on_loss_;
  std::optional<BooleanField> report_;
  WordsField events_ust_;
  WordsField events_kernel_;
  WordsField syscalls_;
  WordsField context_fields_;
  WordsField context_fields_kernel_;
  WordsField nodes_;
  std::vector<ChannelFields> channels_;
  std::vector<ChainFields> chains_;
  std::optional<Template> subbuffers_;
  std::optional<NumberField> subbuffer_size_ust_;
  std::optional<NumberField> subbuffer_size_kernel_;
  BooleanField init_channel_;
  std::optional<NumberField> subbuffer_count_ust_;
  std::optional<NumberField> read_timer_ust_;
  std::optional<NumberField> switch_timer_ust_;
  std::optional<BooleanField> overwrite_ust_;
  std::optional<NumberField> blocking_timeout_ust_;
  std::optional<Template> buffers_ust_;
  std::optional<NumberField> tracefile_size_;
  std::optional<NumberField> tracefile_count_;
  std::optional<Template> url_;
  std::optional<NumberField> live_timer_;
  BooleanField launch_events_;
  BooleanField snapshot_mode_;
  BooleanField snapshot_on_crash_;
  std::optional<Template> snapshot_on_signal_;
  WordsField snapshot_on_events_;
  std::optional<NumberField> snapshot_on_late_callback_;
  std::optional<NumberField> snapshot_on_late_message_;
  std::optional<NumberField> snapshot_limit_;
  std::optional<NumberField> snapshot_size_;
  std::optional<Template> max_overhead_;
  WordsField drop_order_;
  BooleanField dual_session_;
};

// An attribute that ros2 launch does not know.
AttributeSpec extension(const char* name, AttributeType type, const std::string& fallback, const char* help) {
  return {name, type, false, fallback, help, true};
}

std::vector<AttributeSpec> trace_attributes() {
  const tracing::TraceConfig defaults;
  return {
      {"session-name", AttributeType::kText, true, "", "name of the session and of the trace's directory"},
      {"append-timestamp", AttributeType::kBoolean, false, "false", "append -YYYYMMDDHHMMSS to the name"},
      {"base-path", AttributeType::kText, false, "$ROS_TRACE_DIR, $ROS_HOME/tracing or ~/.ros/tracing",
       "directory that will hold the trace's directory"},
      {"append-trace", AttributeType::kBoolean, false, "false", "allow a trace directory that exists"},
      extension("fail-on-loss", AttributeType::kBoolean, "false", "exit with 1 when events were lost"),
      extension("report", AttributeType::kBoolean, "false",
                "make a page of the trace at its end, report.html in its directory"),
      {"events-ust", AttributeType::kWords, false, "all events of provider ros2",
       "userspace events; * matches any text; `'ros2:* except ros2:rcl_init level INFO if vpid > 1'` in quotes"},
      {"events-kernel", AttributeType::kWords, false, "none", "kernel tracepoints"},
      {"syscalls", AttributeType::kWords, false, "none", "system calls"},
      {"context-fields", AttributeType::kWords, false, "procname vpid vtid", "fields added to every event"},
      extension("context-fields-kernel", AttributeType::kWords, "as context-fields",
                "fields added to every event of the kernel; context-fields is for userspace events then"),
      extension("nodes", AttributeType::kWords, "all",
                "record these nodes and processes only, by name; * matches any text"),
      {"subbuffer-size-ust", AttributeType::kInteger, false, fmt::format("{}", defaults.subbuffer_size_ust), "bytes"},
      extension("subbuffers", AttributeType::kText, "fixed",
                "auto: derive subbuffer-size-ust from the number of processes and processors"),
      extension("init-channel", AttributeType::kBoolean, "false",
                "record initialisation events into a channel of their own, ros2_init"),
      extension("subbuffer-count-ust", AttributeType::kInteger, fmt::format("{}", defaults.subbuffer_count_ust),
                "sub-buffers for each processor"),
      extension("read-timer-ust", AttributeType::kInteger, fmt::format("{}", defaults.read_timer_ust),
                "microseconds between two reads of the buffers; 0: traced processes wake the reader"),
      extension("switch-timer-ust", AttributeType::kInteger,
                fmt::format("{}; 0 in snapshot mode", tracing::kSwitchTimer),
                "microseconds until a part-full sub-buffer is written; 0: never"),
      extension("overwrite-ust", AttributeType::kBoolean, "false; true in snapshot mode",
                "when buffers are full lose the oldest events, not the newest"),
      extension("blocking-timeout-ust", AttributeType::kInteger, "0",
                "microseconds that a traced thread waits for room before an event is lost; -1: for ever"),
      extension("buffers-ust", AttributeType::kText, "uid",
                "uid: all processes of a user share buffers; pid: each process has its own"),
      extension("tracefile-size", AttributeType::kInteger, "0",
                "bytes after which a stream goes on in a further file; 0: one file"),
      extension("tracefile-count", AttributeType::kInteger, "0", "files of a stream that are kept; 0: all"),
      extension("url", AttributeType::kText, "", "a relay daemon that gets the trace: net://HOST[:CONTROL[:DATA]]"),
      extension("live-timer", AttributeType::kInteger, "0",
                "microseconds between two deliveries to the viewers of a live session; 0: the session is not live"),
      extension("launch-events", AttributeType::kBoolean, "true",
                "record what the launcher does, too: the events of provider launch"),
      {"subbuffer-size-kernel", AttributeType::kInteger, false, fmt::format("{}", defaults.subbuffer_size_kernel),
       "bytes"},
      {"snapshot-mode", AttributeType::kBoolean, false, "false", "keep the newest events in memory until recorded"},
      extension(
          "snapshot-on-crash", AttributeType::kBoolean, "false",
          "take a snapshot when a process dies unexpectedly, of a signal or with an exit code; implies snapshot-mode"),
      extension("snapshot-on-signal", AttributeType::kText, "none",
                "SIGUSR1 or SIGUSR2: take a snapshot when the launcher gets it; implies snapshot-mode"),
      extension("snapshot-on-events", AttributeType::kWords, "none",
                "take a snapshot when a userspace event comes; written as in events-ust; implies snapshot-mode"),
      extension("snapshot-on-late-callback", AttributeType::kFloat, "none",
                "milliseconds: take a snapshot when a callback takes longer; implies snapshot-mode"),
      extension("snapshot-on-late-message", AttributeType::kFloat, "none",
                "milliseconds: take a snapshot when a message is taken that was published longer before; implies "
                "snapshot-mode"),
      extension("snapshot-limit", AttributeType::kInteger, "10", "snapshots that are kept, the newest ones"),
      extension("snapshot-size", AttributeType::kInteger, "10 userspace sub-buffers", "bytes of a snapshot at most"),
      extension("max-overhead", AttributeType::kText, "none",
                "limit of what recording costs in all traced processes together, such as 2% of a processor; above it "
                "classes of events are dropped"),
      extension("drop-order", AttributeType::kWords, "executor buffers layers messages services callbacks",
                "classes of events that max-overhead may drop, in this order; also events as PROVIDER:NAME"),
      {"dual-session", AttributeType::kBoolean, false, "false", "be the snapshot half of a dual session"}};
}

}  // namespace

ActionType trace_action() {
  return {
      .tag = "trace",
      .help = "Records the run with LTTng, from before the first process starts until the last one has ended.",
      .attributes = trace_attributes(),
      .items = {ChannelFields::item(), ChainFields::item()},
      .make = [](const Fields& fields) { return std::make_shared<Trace>(fields); },
  };
}

}  // namespace launch
