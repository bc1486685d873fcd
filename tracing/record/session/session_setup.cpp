// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_setup.hpp"

#include <fmt/core.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/text/quoted_text.hpp"
#include "tracing/record/account/counters/counter_directory.hpp"
#include "tracing/record/checks/context_check.hpp"
#include "tracing/record/checks/kernel_checks.hpp"
#include "tracing/record/checks/setup_checks.hpp"
#include "tracing/record/kernel/kernel_recorder.hpp"
#include "tracing/record/kernel/pid_namespace.hpp"
#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/daemons_kept_going.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/buffer_sizes.hpp"
#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/ros_events.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/relay_daemon_end.hpp"
#include "tracing/record/session/session_end.hpp"
#include "tracing/record/session/session_listing.hpp"
#include "tracing/record/session/snapshot.hpp"
#include "tracing/record/session/step_timer.hpp"

namespace tracing {
namespace {

constexpr std::chrono::seconds kLongestEnd{2};

// Where a new recording of a trace goes. A second recording into the same directory would truncate the files of the
// first one, so each further one gets a directory of its own inside. A reader of the trace directory reads all of them.
std::string recording_directory(const TraceConfig& config) {
  const std::filesystem::path directory = config.trace_directory();
  if (!std::filesystem::exists(directory / "ust") && !std::filesystem::exists(directory / "kernel")) {
    return directory.string();
  }
  for (int number = 1;; ++number) {
    const std::filesystem::path appended = directory / fmt::format("{}{}", kAppended, number);
    if (!std::filesystem::exists(appended)) {
      return appended.string();
    }
  }
}

int create(const TraceConfig& config, const std::string& directory) {
  const std::string name = config.lttng_session_name();
  if (config.records_snapshots()) {
    return lttng_create_session_snapshot(name.c_str(), nullptr);
  }
  if (config.live_timer != 0) {
    return lttng_create_session_live(name.c_str(), config.destination().c_str(), config.live_timer);
  }
  return lttng_create_session(name.c_str(), config.over_network() ? config.destination().c_str() : directory.c_str());
}

// A session that is destroyed again unless its set-up succeeds, with the directory that was made for it. Throws
// TraceError when it can't be created.
class NewSession {
 public:
  explicit NewSession(const TraceConfig& config);
  ~NewSession();
  NewSession(const NewSession&) = delete;
  NewSession& operator=(const NewSession&) = delete;

  void keep() { kept_ = true; }

 private:
  std::string name_;
  std::string relay_daemon_;  // the address of the one that gets the trace; "": none
  std::string directory_;     // of the recording; "": it existed before, or the trace is on another machine
  bool kept_ = false;
};

NewSession::NewSession(const TraceConfig& config)
    : name_(config.lttng_session_name()),
      relay_daemon_(config.over_network() && !config.records_snapshots() ? config.destination() : "") {
  const std::string directory = config.over_network() ? "" : recording_directory(config);
  if (!std::filesystem::exists(directory)) {
    directory_ = directory;
  }
  const int result = create(config, directory);
  if (result == -LTTNG_ERR_EXIST_SESS) {
    throw TraceError(
        fmt::format("trace session '{}' exists already", name_),
        fmt::format(
            "it may be that of another launch that runs; choose another session-name, or, if nobody uses it any "
            "more, end it with `launch trace stop {}`",
            launch::shell_quoted(name_)));
  }
  check_lttng(result, fmt::format("create trace session '{}'", name_));
}

NewSession::~NewSession() {
  if (kept_) {
    return;
  }
  // The set-up may have failed because one of them is stopped.
  DaemonsKeptGoing daemons;
  if (!relay_daemon_.empty()) {
    keep_relay_daemon(daemons, relay_daemon_);
  }
  if (directory_.empty()) {
    lttng_destroy_session_no_wait(name_.c_str());
    return;
  }
  // LTTng writes there until the session has gone.
  try {
    const auto give_up = std::chrono::steady_clock::now() + kLongestEnd;
    destroy_session(name_, [give_up] { return std::chrono::steady_clock::now() > give_up; });
  } catch (const TraceError&) {
    // It has gone.
  }
  std::error_code none;
  std::filesystem::remove_all(directory_, none);
}

bool has_domain(const std::vector<ChannelPlan>& channels, lttng_domain_type domain) {
  return std::any_of(channels.begin(), channels.end(),
                     [domain](const ChannelPlan& channel) { return channel.domain == domain; });
}

// Where LTTng's kernel modules are not there but the kernel's own tracer can take their place: the kernel channels,
// which are taken out of `channels`. Throws TraceError when neither can be used.
std::vector<ChannelPlan> take_kernel_channels_without_modules(const TraceConfig& config,
                                                              std::vector<ChannelPlan>& channels,
                                                              std::vector<std::string>& warnings) {
  std::string why;
  try {
    check_kernel_tracer();
  } catch (const TraceError& error) {
    // Relay daemons are LTTng's own.
    if (!installed_program(kKernelRecorder) || geteuid() != 0 || config.over_network()) {
      throw;
    }
    why = error.what();
  }
  if (why.empty()) {
    std::string unknown = drop_unknown_kernel_names(channels, kernel_event_names(), syscall_names());
    if (!unknown.empty()) {
      warnings.push_back(std::move(unknown));
    }
    check_kernel_context_fields(channels, kernel_modules_version());
    return {};
  }
  std::vector<ChannelPlan> kernel;
  for (const ChannelPlan& channel : channels) {
    if (channel.domain == LTTNG_DOMAIN_KERNEL) {
      kernel.push_back(channel);
    }
  }
  check_kernel_recorder_fields(kernel);
  std::erase_if(channels, [](const ChannelPlan& channel) { return channel.domain == LTTNG_DOMAIN_KERNEL; });
  if (channels.empty()) {
    throw TraceError("kernel events are recorded through tracefs, and only beside userspace events",
                     "name some in events-ust; LTTng's own kernel tracer is in lttng-modules-dkms");
  }
  warnings.push_back(fmt::format("{}; they are recorded through tracefs instead", why));
  if (!is_in_first_pid_namespace()) {
    // Else a thread of the machine would be taken for the thread of a node that has the same number here.
    for (ChannelPlan& channel : channels) {
      const auto& fields = channel.context_fields;
      if (!channel.python && std::find(fields.begin(), fields.end(), "pid_ns") == fields.end()) {
        channel.context_fields.emplace_back("pid_ns");
      }
    }
    warnings.emplace_back(
        "this launch has a namespace of process ids: the kernel's events have other numbers for its threads, so they "
        "do "
        "not tell where the time of its callbacks goes; LTTng's modules know both numbers");
  }
  return kernel;
}

// Creates, configures and starts the session. The kernel channels `kernel` are recorded through tracefs.
void set_up(const TraceConfig& config, const std::vector<ChannelPlan>& channels, const std::vector<ChannelPlan>& kernel,
            SetupReport& report, StepTimer& timer) {
  const std::string session_name = config.lttng_session_name();
  NewSession session(config);
  note_session(config.event_counters, session_name);
  if (config.records_snapshots()) {
    add_snapshot_output(config);
  }
  timer.finished("create session");
  for (const ChannelPlan& channel : channels) {
    enable_channel(session_name, channel);
    timer.finished("channel " + channel.channel);
    enable_events(session_name, channel);
    timer.finished("events " + channel.channel);
    add_contexts(session_name, channel);
    timer.finished("context fields " + channel.channel);
  }
  check_lttng(lttng_start_tracing(session_name.c_str()), fmt::format("start trace session '{}'", session_name));
  timer.finished("start");
  if (!kernel.empty()) {
    std::string unknown = start_kernel_recorder(
        *installed_program(kKernelRecorder), session_name, recorder_directory(session_name), kernel,
        config.records_snapshots() ? KernelRecording::kSnapshots : KernelRecording::kEverything,
        consumers_of(session_daemon_pid()));
    if (!unknown.empty()) {
      report.warnings.push_back(std::move(unknown));
    }
    timer.finished("kernel recorder");
  }
  session.keep();
}

// A daemon without a consumer is of no use. It is ended if a launch has started it and nobody has a session there.
bool restart_unused_daemon() {
  constexpr std::chrono::seconds kSessionIsGone{2};
  constexpr std::chrono::milliseconds kPause{5};
  if (!session_daemon_is_ours()) {
    return false;
  }
  const auto give_up = std::chrono::steady_clock::now() + kSessionIsGone;  // LTTng tells nobody when it is
  while (!list_sessions().empty()) {
    if (std::chrono::steady_clock::now() > give_up) {
      return false;
    }
    std::this_thread::sleep_for(kPause);
  }
  restart_session_daemon();
  return true;
}

}  // namespace

SetupReport start_session(const TraceConfig& config) {
  SetupReport report{.trace_directory = config.destination(), .steps = {}, .warnings = {}};
  StepTimer timer(report.steps);

  check_config(config);
  std::vector<ChannelPlan> channels = plan_channels(config, report.warnings);
  if (has_domain(channels, LTTNG_DOMAIN_UST)) {
    fit_into_shared_memory(channels, free_shared_memory(), static_cast<std::uint64_t>(get_nprocs_conf()),
                           report.warnings);
  }
  for (const ChannelPlan& channel : channels) {
    for (const EventRule& rule : channel.events) {
      if (std::string unknown = why_no_ros_event(rule.pattern); !unknown.empty()) {
        report.warnings.push_back(std::move(unknown));
      }
    }
  }
  timer.finished("checks");

  report.started_daemon = ensure_session_daemon();
  check_daemons_not_stopped();
  timer.finished("session daemon");
  for (std::string& warning : context_warnings(channels)) {
    report.warnings.push_back(std::move(warning));
  }
  std::vector<ChannelPlan> through_tracefs;
  if (has_domain(channels, LTTNG_DOMAIN_KERNEL)) {
    through_tracefs = take_kernel_channels_without_modules(config, channels, report.warnings);
    timer.finished("kernel tracer");
  }

  try {
    set_up(config, channels, through_tracefs, report, timer);
  } catch (const ConsumerEnded&) {
    if (!restart_unused_daemon()) {
      throw;
    }
    report.warnings.emplace_back(
        "LTTng's consumer had been killed; the session daemon, which a launch had started, was restarted");
    timer.finished("session daemon again");
    set_up(config, channels, through_tracefs, report, timer);
  }
  report.notes = prefer_daemons(session_daemon_pid());
  timer.finished("consumer priority");
  return report;
}

}  // namespace tracing
