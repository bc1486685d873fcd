// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <lttng/lttng.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "launcher/base/monotonic_clock.hpp"
#include "tracing/account/cost_measurement.hpp"
#include "tracing/account/loss_account.hpp"
#include "tracing/account/losses_by_process.hpp"
#include "tracing/account/packet_losses.hpp"
#include "tracing/account/session_step.hpp"
#include "tracing/account/stream_packets.hpp"
#include "tracing/account/unwritten_data.hpp"
#include "tracing/account/verdict.hpp"
#include "tracing/checks/context_check.hpp"
#include "tracing/checks/kernel_checks.hpp"
#include "tracing/checks/setup_checks.hpp"
#include "tracing/checks/unreachable_processes.hpp"
#include "tracing/kernel/kernel_recorder.hpp"
#include "tracing/lttng/channels.hpp"
#include "tracing/lttng/consumer_priority.hpp"
#include "tracing/lttng/installed_program.hpp"
#include "tracing/lttng/lttng_error.hpp"
#include "tracing/lttng/session_daemon.hpp"
#include "tracing/plan/channel_plan.hpp"
#include "tracing/plan/plan_channels.hpp"
#include "tracing/plan/shared_memory_fit.hpp"
#include "tracing/plan/trace_config.hpp"
#include "tracing/plan/trace_error.hpp"
#include "tracing/session/event_watch.hpp"
#include "tracing/session/new_session.hpp"
#include "tracing/session/session_details.hpp"
#include "tracing/session/session_end.hpp"
#include "tracing/session/session_listing.hpp"
#include "tracing/session/session_store.hpp"
#include "tracing/session/snapshot.hpp"
#include "tracing/session/step_timer.hpp"
#include "tracing/session/traceable_events.hpp"
#include "tracing/session/tracer.hpp"

namespace tracing {
namespace {

// A verdict that can't be written, as on a full disk, is no reason to lose the account.
void judge(LossAccount& losses, LossesByProcess& by_process, const std::vector<Stream>& streams,
           const std::string& name, const std::string& directory, std::uint64_t stopped) {
  explain_losses(losses, streams);
  const std::string no_room = why_no_room(directory);
  find_unwritten(losses, streams, stopped, !no_room.empty());
  losses.damage = describe_damage(losses, no_room, directory);
  by_process.look_into(directory, streams);  // a damaged trace is not complete
  try {
    write_verdict(losses, name, directory);
  } catch (const TraceError& error) {
    losses.unwritten_verdict = error.what();
  }
}

// The streams of a recording that has been written.
std::vector<Stream> streams_of(const LossAccount& losses, const std::string& directory,
                               const std::function<bool()>& give_up) {
  std::set<std::string> in_files;
  for (const ChannelLoss& channel : losses.channels) {
    if (channel.tracefile_size != 0) in_files.insert(channel.channel);
  }
  return read_streams(directory, in_files, give_up);
}

// The directory of the kernel recorder of a session. It is beside the recorded trace or beside the snapshots.
std::string recorder_directory(const std::string& name) {
  if (const auto snapshots = snapshot_directory(name)) return *snapshots;
  const std::optional<SessionSummary> session = find_session(name);
  return session ? session->path : "";
}

class LttngTracer : public Tracer {
 public:
  SetupReport start(const TraceConfig& config) override;
  LossAccount finish(const TraceConfig& config, const std::function<bool()>& give_up) override;
  void pause(const std::string& lttng_session_name) override;
  void resume(const std::string& lttng_session_name) override;
  void record_snapshot(const std::string& lttng_session_name) override;
  std::vector<SessionSummary> sessions() override { return list_sessions(); }
  SessionDetails status(const std::string& lttng_session_name) override { return describe_session(lttng_session_name); }
  TraceableEvents traceable_events() override { return list_traceable_events(); }
  std::vector<std::string> unreachable_processes() override { return unreachable_process_warnings(); }
  void save(const std::string& lttng_session_name, const std::string& directory) override {
    save_session(lttng_session_name, directory);
  }
  void load(const std::string& lttng_session_name, const std::string& directory) override {
    ensure_session_daemon();
    load_session(lttng_session_name, directory);
  }
};

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
    if (!installed_program(kKernelRecorder) || geteuid() != 0 || config.over_network()) throw;
    why = error.what();
  }
  if (why.empty()) {
    std::string unknown = drop_unknown_kernel_names(channels, kernel_event_names(), syscall_names());
    if (!unknown.empty()) warnings.push_back(std::move(unknown));
    check_kernel_context_fields(channels, kernel_modules_version());
    return {};
  }
  std::vector<ChannelPlan> kernel;
  for (const ChannelPlan& channel : channels) {
    if (channel.domain == LTTNG_DOMAIN_KERNEL) kernel.push_back(channel);
  }
  check_kernel_recorder_fields(kernel);
  std::erase_if(channels, [](const ChannelPlan& channel) { return channel.domain == LTTNG_DOMAIN_KERNEL; });
  if (channels.empty()) {
    throw TraceError("kernel events are recorded through tracefs, and only beside userspace events",
                     "name some in events-ust; LTTng's own kernel tracer is in lttng-modules-dkms");
  }
  warnings.push_back(fmt::format("{}; they are recorded through tracefs instead", why));
  return kernel;
}

SetupReport LttngTracer::start(const TraceConfig& config) {
  SetupReport report{.trace_directory = config.destination(), .steps = {}, .warnings = {}};
  StepTimer timer(report.steps);

  check_config(config);
  std::vector<ChannelPlan> channels = plan_channels(config, report.warnings);
  if (has_domain(channels, LTTNG_DOMAIN_UST)) {
    fit_into_shared_memory(channels, free_shared_memory(), static_cast<std::uint64_t>(get_nprocs_conf()),
                           report.warnings);
  }
  timer.finished("checks");

  report.started_daemon = ensure_session_daemon();
  timer.finished("session daemon");
  for (std::string& warning : context_warnings(channels)) report.warnings.push_back(std::move(warning));
  std::vector<ChannelPlan> through_tracefs;
  if (has_domain(channels, LTTNG_DOMAIN_KERNEL)) {
    through_tracefs = take_kernel_channels_without_modules(config, channels, report.warnings);
    timer.finished("kernel tracer");
  }

  const std::string session_name = config.lttng_session_name();
  NewSession session(config);
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
  if (!through_tracefs.empty()) {
    std::string unknown = start_kernel_recorder(
        *installed_program(kKernelRecorder), session_name, recorder_directory(session_name), through_tracefs,
        config.records_snapshots() ? KernelRecording::kSnapshots : KernelRecording::kEverything);
    if (!unknown.empty()) report.warnings.push_back(std::move(unknown));
    timer.finished("kernel recorder");
  }
  report.notes = prefer_consumers(session_daemon_pid());
  timer.finished("consumer priority");
  session.keep();
  return report;
}

LossAccount LttngTracer::finish(const TraceConfig& config, const std::function<bool()>& give_up) {
  const std::string name = config.lttng_session_name();
  check_daemon_not_stopped();
  std::vector<SessionStep> steps;
  StepTimer timer(steps);
  const std::optional<SessionSummary> session = find_session(name);
  // One that was paused has written its last packets before.
  const std::uint64_t stopped = session && session->active ? static_cast<std::uint64_t>(launch::monotonic_time()) : 0;
  LossAccount losses = stop_and_account(name, give_up, timer);
  LossesByProcess by_process(config, losses);
  timer.finished("losses");
  std::optional<std::uint64_t> lost_by_kernel;
  std::string kernel_failure;
  if (session) {
    try {
      lost_by_kernel = finish_kernel_recorder(recorder_directory(name));
    } catch (const TraceError& error) {
      kernel_failure = error.what();
    }
  }
  const bool local = session && session->path.starts_with('/');  // else it went to a relay daemon
  std::error_code unreadable;
  const bool rotated = local && std::filesystem::exists(session->path + "/archives", unreadable);
  rotated ? destroy_rotated_session(name, give_up) : destroy_session(name, give_up);
  timer.finished("destroy");
  EventWatch::clean_up(name);  // of a launcher that was killed
  const bool readable = local && !session->snapshot;
  std::vector<Stream> streams;
  if (readable) {
    streams = streams_of(losses, session->path, give_up);
    if (give_up && give_up()) {
      // A part of the packets would give wrong sums and damage that is none.
      streams.clear();
      losses.cut_short = true;
    } else {
      count_in_packets(losses, streams);
    }
  }
  if (lost_by_kernel && !session->snapshot) {
    losses.channels.push_back({.domain = "kernel",
                               .channel = kKernelRecorderChannel,
                               .discarded_events = *lost_by_kernel,
                               .counted_by = LossSource::kKernelRecorder});
  }
  const bool hurried = losses.cut_short || (give_up && give_up());
  // The first session on a machine takes some 30 ms longer to end, because of the measurement. It disturbs no process
  // then.
  if (!losses.processes.empty() && !hurried) losses.cost = try_event_cost(config.context_fields_ust);
  timer.finished("cost of events");
  if (readable) {
    judge(losses, by_process, streams, name, session->path, stopped);
  }
  timer.finished("verdict");
  losses.steps = std::move(steps);
  if (!kernel_failure.empty()) throw TraceError(kernel_failure);
  return losses;
}

void LttngTracer::pause(const std::string& name) {
  // Waits for the data, because a user who pauses wants to look at the trace.
  check_lttng(lttng_stop_tracing(name.c_str()), fmt::format("pause trace session '{}'", name));
  pause_kernel_recorder(recorder_directory(name));
}

void LttngTracer::resume(const std::string& name) {
  check_lttng(lttng_start_tracing(name.c_str()), fmt::format("resume trace session '{}'", name));
  resume_kernel_recorder(recorder_directory(name));
}

void LttngTracer::record_snapshot(const std::string& name) {
  record_and_clear(name);
}

}  // namespace

std::unique_ptr<Tracer> make_lttng_tracer() {
  return std::make_unique<LttngTracer>();
}

}  // namespace tracing
