// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "tracing/record/account/absence.hpp"
#include "tracing/record/account/cost_measurement.hpp"
#include "tracing/record/account/counters/counter_directory.hpp"
#include "tracing/record/account/counters/session_pauses.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_counters.hpp"
#include "tracing/record/account/losses_by_process.hpp"
#include "tracing/record/account/packet_losses.hpp"
#include "tracing/record/account/readable_traces.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/account/unwritten_data.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/checks/unreachable_processes.hpp"
#include "tracing/record/kernel/kernel_recorder.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/daemons_kept_going.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/event_watch.hpp"
#include "tracing/record/session/held_up_streams.hpp"
#include "tracing/record/session/relay_daemon_end.hpp"
#include "tracing/record/session/run_watch.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/session_end.hpp"
#include "tracing/record/session/session_listing.hpp"
#include "tracing/record/session/session_setup.hpp"
#include "tracing/record/session/session_store.hpp"
#include "tracing/record/session/snapshot.hpp"
#include "tracing/record/session/step_timer.hpp"
#include "tracing/record/session/traceable_events.hpp"
#include "tracing/record/session/tracer.hpp"

namespace tracing {
namespace {

constexpr std::chrono::milliseconds kLongestEndOfAStuckSession{1000};

// A damaged trace is not complete, so its damage is looked for first.
void judge(LossAccount& losses, LossesByProcess& by_process, const std::vector<Stream>& streams,
           const std::string& directory, std::uint64_t stopped) {
  explain_losses(losses, streams);
  find_unwritten(losses, streams, stopped, by_process.process_ends());
  losses.damage = describe_damage(losses, {.no_room = why_no_room(directory), .killed = by_process.killed()});
  if (const std::string unreadable = describe_unreadable(directory); !unreadable.empty()) {
    losses.damage += (losses.damage.empty() ? "" : "; ") + unreadable;
  }
  by_process.look_for_absent_events(directory);
  by_process.look_into(directory, streams);
}

// A verdict that can't be written, as on a full disk, is no reason to lose the account.
void write(LossAccount& losses, const std::string& session_name, const std::string& directory) {
  try {
    write_verdict(losses, session_name, directory);
    if (std::filesystem::path(directory).filename().string().starts_with(kAppended)) {
      note_appended(directory, losses.complete());
    }
  } catch (const TraceError& error) {
    losses.unwritten_verdict = error.what();
  }
}

// The launch that records a session knows its counters; other programs look for them.
TraceConfig with_counters(TraceConfig config) {
  if (config.event_counters.empty()) {
    config.event_counters = CounterDirectory::of_session(config.lttng_session_name());
  }
  return config;
}

// For a session that ended in an error: what is in its directory is not complete.
void write_failed_verdict(const std::string& session_name, const std::string& directory, const std::string& failure) {
  std::error_code none;
  if (!directory.starts_with('/') || !std::filesystem::is_directory(directory, none)) {
    return;
  }
  LossAccount losses;
  const std::string unreadable = describe_unreadable(directory);
  losses.damage = failure + (unreadable.empty() ? "" : "; " + unreadable);
  try {
    write_verdict(losses, session_name, directory);
  } catch (const TraceError&) {
    // The error of the session is the one to tell.
  }
}

// A session that ended before has its verdict, or its snapshots have theirs.
bool is_judged(const std::string& directory) {
  std::error_code none;
  return std::filesystem::exists(std::filesystem::path(directory) / kVerdictFile, none) ||
         !snapshots_in(directory).empty();
}

// Without its session nobody else would end it.
void end_kernel_recorder(const std::string& directory) {
  if (!directory.starts_with('/')) {
    return;
  }
  try {
    finish_kernel_recorder(directory);
  } catch (const TraceError&) {
    // The error of the session is the one to tell.
  }
}

// The channels that are recorded into files of a limited size.
std::set<std::string> channels_in_files(const LossAccount& losses) {
  std::set<std::string> in_files;
  for (const ChannelLoss& channel : losses.channels) {
    if (channel.tracefile_size != 0) {
      in_files.insert(channel.channel);
    }
  }
  return in_files;
}

// Waits until all streams of the recording have their last packets, and have told in them what they have lost.
void end_streams(LossAccount& losses, const std::string& name, const std::string& directory, std::uint64_t stopped,
                 const std::function<bool()>& give_up) {
  const std::set<std::string> in_files = channels_in_files(losses);
  if (!losses.stuck && !streams_end_after(directory, in_files, stopped) &&
      end_packets_again(name, directory, give_up)) {
    losses.channels = read_losses(name).channels;
  }
  wait_for_last_packets(directory, in_files, stopped, give_up);
}

class LttngTracer : public Tracer {
 public:
  SetupReport start(const TraceConfig& config) override { return start_session(config); }
  std::unique_ptr<RunWatch> watch(const TraceConfig& config, std::function<void(const std::string&)> told) override {
    return std::make_unique<RunWatch>(config, std::move(told));
  }
  LossAccount finish(const TraceConfig& config, const std::function<bool()>& give_up) override;
  std::optional<LossAccount> pause(const std::string& lttng_session_name) override;
  void resume(const std::string& lttng_session_name) override;
  std::string record_snapshot(const std::string& lttng_session_name) override;
  std::vector<SessionSummary> sessions() override { return list_sessions(); }
  SessionDetails status(const std::string& name) override { return with_held_up_streams(describe_session(name)); }
  TraceableEvents traceable_events() override { return list_traceable_events(); }
  std::vector<std::string> unreachable_processes() override { return unreachable_process_warnings(); }
  void save(const std::string& lttng_session_name, const std::string& directory) override {
    check_daemon_not_stopped();
    save_session(lttng_session_name, directory);
  }
  void load(const std::string& lttng_session_name, const std::string& directory) override {
    ensure_session_daemon();
    load_session(lttng_session_name, directory);
  }
};

LossAccount LttngTracer::finish(const TraceConfig& config, const std::function<bool()>& give_up) {
  const std::string name = config.lttng_session_name();
  std::vector<SessionStep> steps;
  StepTimer timer(steps);
  DaemonsKeptGoing daemons;
  if (config.over_network()) {
    // Its session can't even be listed while the session daemon waits for the relay daemon.
    keep_relay_daemon(daemons, config.destination());
  }
  std::optional<SessionSummary> session;
  try {
    session = find_session(name);
    if (session) {
      if (const std::optional<RelayConnection> connection = connection_of(*session)) {
        daemons.keep_relay_daemons([connection] { return connection->stopped_daemons(); });
      }
    }
  } catch (const TraceError& error) {
    // When the daemon goes on, the session can be ended, and gets another verdict.
    if (!config.records_snapshots() && !config.over_network()) {
      write_failed_verdict(name, config.trace_directory(), error.what());
    }
    throw TraceError(error.what(), error.remedy() + (error.remedy().empty() ? "" : "; ") + end_it_later(name));
  }
  // One that was paused has written its last packets before.
  const std::uint64_t stopped = session && session->active ? static_cast<std::uint64_t>(launch::monotonic_time()) : 0;
  const std::optional<Absence> relay_daemon_gone = session ? wait_for_relay_daemon(*session) : std::nullopt;
  const auto write_failure = [&](const TraceError& error) {
    const bool is_known = session && !session->path.empty();
    const std::string directory = is_known ? session->path : config.over_network() ? "" : config.trace_directory();
    end_kernel_recorder(directory);
    const bool ended_before = !session && !config.append_trace && is_judged(directory);
    if (!config.records_snapshots() && !ended_before) {
      write_failed_verdict(name, directory, error.what());
    }
  };
  LossAccount losses;
  bool is_destroyed = false;
  try {
    losses = stop_and_account(name, session ? session->path : "", give_up, timer);
  } catch (const ConsumerEnded& error) {
    // With LTTng 2.13.15 the consumer was now and then gone after the relay daemon was.
    if (!relay_daemon_gone) {
      write_failure(error);
      throw;
    }
    is_destroyed = true;
  } catch (const TraceError& error) {
    write_failure(error);
    throw;
  }
  const bool local = session && session->path.starts_with('/');  // else it went to a relay daemon
  LossesByProcess by_process(with_counters(config), losses);
  if (is_destroyed) {
    losses.absences.push_back(lost_with_consumer());
  } else if (relay_daemon_gone) {
    losses.absences.push_back(*relay_daemon_gone);
  }
  timer.finished("losses");
  if (local && !session->snapshot && !losses.cut_short) {
    end_streams(losses, name, session->path, stopped, give_up);
  }
  timer.finished("last packets");
  std::optional<std::uint64_t> lost_by_kernel;
  std::string kernel_failure;
  if (session) {
    try {
      lost_by_kernel = finish_kernel_recorder(recorder_directory(name));
    } catch (const TraceError& error) {
      kernel_failure = error.what();
      losses.absences.push_back({.text = kernel_failure, .is_loss = true});
    }
  }
  if (session) {
    losses.of_snapshots = session->snapshot;
  }
  losses.directory = recorder_directory(name);
  if (!losses.directory.starts_with('/')) {
    losses.directory.clear();
  }
  std::error_code unreadable;
  const bool rotated = local && std::filesystem::exists(session->path + "/archives", unreadable);
  std::optional<TraceError> failure;
  try {
    // What has not moved for ten seconds is not waited for that long once more.
    const auto latest = std::chrono::steady_clock::now() + kLongestEndOfAStuckSession;
    const auto no_longer = [&give_up, stuck = losses.stuck, latest] {
      return (give_up && give_up()) || (stuck && std::chrono::steady_clock::now() > latest);
    };
    if (!is_destroyed) {
      rotated ? static_cast<void>(destroy_rotated_session(name, no_longer)) : destroy_session(name, no_longer);
    }
  } catch (const TraceError& error) {
    failure = error;  // what has been written is judged all the same
  }
  timer.finished("destroy");
  losses.wrote_nothing = !losses.directory.empty() && !std::filesystem::exists(losses.directory, unreadable);
  losses.notes = daemons.notes();
  EventWatch::clean_up(name);  // of a launcher that was killed
  const bool readable = local && !session->snapshot;
  std::vector<Stream> streams;
  if (readable) {
    for (Absence& absence : put_unreadable_aside(session->path)) {
      losses.absences.push_back(std::move(absence));
    }
    streams = read_streams(session->path, channels_in_files(losses), give_up);
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
                               .counted_by = LossSource::kTracefs});
  }
  if (readable) {
    judge(losses, by_process, streams, session->path, stopped);
  }
  timer.finished("losses by process");
  const bool hurried = losses.cut_short || (give_up && give_up());
  // The first session on a machine takes some 30 ms longer to end, because of the measurement. It disturbs no process
  // then.
  if (!losses.processes.empty() && !hurried) {
    losses.cost = try_event_cost(config.context_fields_ust);
  }
  timer.finished("cost of events");
  losses.tracetools = config.tracetools;
  if (readable) {
    write(losses, name, session->path);
  }
  timer.finished("verdict");
  losses.steps = std::move(steps);
  if (failure) {
    throw TraceError(*failure);
  }
  if (!kernel_failure.empty()) {
    throw TraceError(kernel_failure);
  }
  return losses;
}

std::optional<LossAccount> LttngTracer::pause(const std::string& name) {
  check_daemons_not_stopped();
  const std::optional<SessionSummary> session = find_session(name);
  if (session) {
    look_for_relay_daemon(*session);
  }
  const auto stopped = static_cast<std::uint64_t>(launch::monotonic_time());
  // Waits for the data, because a user who pauses wants to look at the trace.
  note_pause(CounterDirectory::of_session(name), name);
  check_lttng(lttng_stop_tracing_no_wait(name.c_str()), fmt::format("pause trace session '{}'", name));
  const DataEnd end = wait_for_data(name, session ? session->path : "", {});
  pause_kernel_recorder(recorder_directory(name));
  if (!session || !session->active || session->snapshot || !session->path.starts_with('/')) {
    return std::nullopt;
  }
  // So a trace that is looked at meanwhile has a verdict. The end of the session writes another one.
  try {
    TraceConfig config;
    config.session_name = name;
    LossAccount losses = read_losses(name);
    losses.directory = session->path;
    losses.stuck = end == DataEnd::kStuck;
    LossesByProcess by_process(with_counters(config), losses);
    end_streams(losses, name, session->path, stopped, {});
    const std::vector<Stream> streams = read_streams(session->path, channels_in_files(losses), {});
    count_in_packets(losses, streams);
    judge(losses, by_process, streams, session->path, stopped);
    if (!losses.processes.empty()) {
      losses.cost = try_event_cost(config.context_fields_ust);
    }
    write(losses, name, session->path);
    return losses;
  } catch (const TraceError&) {
    return std::nullopt;  // the session has paused all the same
  }
}

void LttngTracer::resume(const std::string& name) {
  check_daemons_not_stopped();
  const std::optional<SessionSummary> session = find_session(name);
  check_lttng(lttng_start_tracing(name.c_str()), fmt::format("resume trace session '{}'", name));
  if (session && session->path.starts_with('/')) {
    // The verdict of the pause does not know what comes now.
    std::error_code none;
    std::filesystem::remove(std::filesystem::path(session->path) / kVerdictFile, none);
  }
  note_resume(CounterDirectory::of_session(name), name);
  resume_kernel_recorder(recorder_directory(name));
}

std::string LttngTracer::record_snapshot(const std::string& name) {
  check_daemon_not_stopped();
  const std::uint64_t asked = record_and_clear(name);
  std::string written;
  if (const std::optional<std::filesystem::path> directory = snapshot_directory(name)) {
    if (const std::vector<std::filesystem::path> snapshots = snapshots_in(*directory); !snapshots.empty()) {
      written = snapshots.back();
      judge_snapshot(written, name, CounterDirectory::of_session(name), {"launch trace record_snapshot"},
                     {.asked = asked});
    }
  }
  have_objects_told_again(name);
  return written;
}

}  // namespace

std::unique_ptr<Tracer> make_lttng_tracer() {
  return std::make_unique<LttngTracer>();
}

}  // namespace tracing
