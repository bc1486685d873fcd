#include <fmt/core.h>
#include <lttng/lttng.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "tracing/session/channels.hpp"
#include "tracing/session/consumer_priority.hpp"
#include "tracing/session/context_check.hpp"
#include "tracing/session/event_counters.hpp"
#include "tracing/session/event_watch.hpp"
#include "tracing/session/installed_program.hpp"
#include "tracing/session/kernel_checks.hpp"
#include "tracing/session/kernel_recorder.hpp"
#include "tracing/session/loss_account.hpp"
#include "tracing/session/lttng_error.hpp"
#include "tracing/session/overhead_guard.hpp"
#include "tracing/session/packet_index.hpp"
#include "tracing/session/process_account.hpp"
#include "tracing/session/session_daemon.hpp"
#include "tracing/session/session_listing.hpp"
#include "tracing/session/session_store.hpp"
#include "tracing/session/setup_checks.hpp"
#include "tracing/session/snapshot.hpp"
#include "tracing/session/tracer.hpp"
#include "tracing/session/unreachable_processes.hpp"
#include "tracing/session/verdict.hpp"

namespace tracing {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// LTTng has no event for "all data is written" or "the session is gone", and its own waiting calls look only every 200
// and 500 ms. The state is asked for instead, soon at first and then less often.
class Polling {
 public:
  void pause() {
    std::this_thread::sleep_for(interval_);
    interval_ = std::min(interval_ * 2, kLongest);
  }

 private:
  static constexpr milliseconds kShortest{1};
  static constexpr milliseconds kLongest{10};
  milliseconds interval_ = kShortest;
};

class StepTimer {
 public:
  explicit StepTimer(std::vector<SetupStep>& steps) : steps_(steps) {}
  void finished(std::string name) {
    const auto now = steady_clock::now();
    steps_.push_back({std::move(name), now - std::exchange(begin_, now)});
  }

 private:
  std::vector<SetupStep>& steps_;
  steady_clock::time_point begin_ = steady_clock::now();
};

std::optional<SessionSummary> find_session(const std::string& name) {
  for (SessionSummary& session : list_sessions()) {
    if (session.name == name) return std::move(session);
  }
  return std::nullopt;
}

// Where a new recording of a trace goes. A second recording into the same directory would truncate the files of the
// first one, so each further one gets a directory of its own inside: whoever reads the trace directory reads all of
// them.
std::string recording_directory(const TraceConfig& config) {
  const std::filesystem::path directory = config.trace_directory();
  if (!std::filesystem::exists(directory / "ust") && !std::filesystem::exists(directory / "kernel")) {
    return directory.string();
  }
  for (int number = 1;; ++number) {
    const std::filesystem::path appended = directory / fmt::format("appended-{}", number);
    if (!std::filesystem::exists(appended)) return appended.string();
  }
}

// A session that is destroyed again unless its set-up succeeds.
class NewSession {
 public:
  explicit NewSession(const TraceConfig& config) : name_(config.lttng_session_name()) {
    const int result = create(config);
    if (result == -LTTNG_ERR_EXIST_SESS) {
      throw TraceError(fmt::format("trace session '{}' exists already", name_),
                       fmt::format("end it with `lttng destroy {}`, or choose another session-name", name_));
    }
    check_lttng(result, fmt::format("create trace session '{}'", name_));
  }
  ~NewSession() {
    if (!kept_) lttng_destroy_session_no_wait(name_.c_str());
  }
  NewSession(const NewSession&) = delete;
  NewSession& operator=(const NewSession&) = delete;

  void keep() { kept_ = true; }

 private:
  int create(const TraceConfig& config) const {
    if (config.records_snapshots()) return lttng_create_session_snapshot(name_.c_str(), nullptr);
    if (config.live_timer != 0) {
      return lttng_create_session_live(name_.c_str(), config.destination().c_str(), config.live_timer);
    }
    const std::string destination = config.over_network() ? config.destination() : recording_directory(config);
    return lttng_create_session(name_.c_str(), destination.c_str());
  }

  std::string name_;
  bool kept_ = false;
};

void stop(const std::string& name) {
  // Takes 200 ms when applications have registered since the last stop: the consumer daemon then waits in steps of this
  // length for its own thread that writes the metadata.
  const int result = lttng_stop_tracing_no_wait(name.c_str());
  if (result != -LTTNG_ERR_TRACE_ALREADY_STOPPED) check_lttng(result, fmt::format("stop trace session '{}'", name));
}

// Stops the session and reads its losses once they are final, or as they are when give_up says so. A session that fails
// in this can't be used any more and is destroyed.
LossAccount stop_and_account(const std::string& name, const std::function<bool()>& give_up) {
  try {
    stop(name);
    const std::string doing = fmt::format("write the data of trace session '{}'", name);
    bool cut_short = false;
    for (Polling data; check_lttng(lttng_data_pending(name.c_str()), doing) > 0 && !cut_short; data.pause()) {
      cut_short = give_up && give_up();
    }
    LossAccount losses = read_losses(name);
    losses.cut_short = cut_short;
    return losses;
  } catch (const TraceError&) {
    lttng_destroy_session_no_wait(name.c_str());
    throw;
  }
}

std::uint64_t monotonic_now() {
  return static_cast<std::uint64_t>(steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1));
}

// Which process lost how much, for the losses of a session that has been stopped.
// What cannot be found out leaves the attribution unknown: the session ends and its verdict is written all the same.
class LossesByProcess {
 public:
  LossesByProcess(const TraceConfig& config, LossAccount& losses) : losses_(losses) {
    if (!config.event_counters.empty()) counts_ = EventCounters(config.event_counters).read();
    losses.processes = account_processes(counts_, monotonic_now());
    losses.cuts = read_cuts(config);
    if (losses.complete()) losses.attribution = LossAttribution::kExact;
    try {
      if (needed()) events_ = read_recorded_events(config.lttng_session_name());
    } catch (const TraceError&) {
      unknown_ = true;
    }
  }

  // Reads the trace, which takes a second for a million events; only when something was lost.
  void look_into(const std::string& recording) {
    const std::optional<std::filesystem::path> report = installed_program("launch-report");
    if (!needed() || unknown_) return;
    try {
      RecordedProcesses recorded;
      if (report) {
        const std::string output = program_output(*report, {"--recorded", recording});
        if (!output.empty()) recorded = parse_recorded_processes(output);
      }
      if (recorded.empty()) counts_.clear();  // then only buffers of its own tell what a process lost
      attribute_losses(losses_, counts_, events_, recorded, read_packet_index(recording));
    } catch (const TraceError&) {
      losses_.attribution = LossAttribution::kUnknown;
    }
  }

 private:
  // Userspace has lost something, and there is time to look.
  bool needed() const {
    return !losses_.cut_short &&
           std::any_of(losses_.channels.begin(), losses_.channels.end(), [](const ChannelLoss& channel) {
             return channel.domain == "ust" && channel.discarded_events + channel.lost_packets != 0;
           });
  }

  LossAccount& losses_;
  std::vector<EventCounts> counts_;
  RecordedEvents events_;
  bool unknown_ = false;
};

// A verdict that can't be written, as on a full disk, is no reason to lose the account.
void judge(LossAccount& losses, const std::string& name, const std::string& directory) {
  explain_losses(losses, directory);
  losses.damage = find_damage(directory);
  try {
    write_verdict(losses, name, directory);
  } catch (const TraceError& error) {
    losses.unwritten_verdict = error.what();
  }
}

// Where the kernel recorder of a session runs: beside what is recorded, or beside the snapshots.
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
  const std::optional<SessionSummary> session = find_session(name);
  LossAccount losses = stop_and_account(name, give_up);
  LossesByProcess by_process(config, losses);
  std::optional<ChannelLoss> kernel;
  std::string kernel_failure;
  if (session) {
    try {
      kernel = finish_kernel_recorder(recorder_directory(name));
    } catch (const TraceError& error) {
      kernel_failure = error.what();
    }
  }
  check_lttng(lttng_destroy_session_no_wait(name.c_str()), fmt::format("destroy trace session '{}'", name));
  for (Polling gone; find_session(name).has_value(); gone.pause()) {
    if (give_up && give_up()) break;
  }
  EventWatch::clean_up(name);                                    // of a launcher that was killed
  const bool local = session && session->path.starts_with('/');  // else it went to a relay daemon
  if (kernel && !session->snapshot) losses.channels.push_back(*kernel);
  const bool hurried = losses.cut_short || (give_up && give_up());
  // The first session on a machine takes some 30 ms longer to end: the measurement. It disturbs nobody then.
  if (!losses.processes.empty() && !hurried) losses.cost = try_event_cost(config.context_fields_ust);
  if (local && !session->snapshot) by_process.look_into(session->path);
  if (local && !session->snapshot) judge(losses, name, session->path);
  if (!kernel_failure.empty()) throw TraceError(kernel_failure);
  return losses;
}

void LttngTracer::pause(const std::string& name) {
  // Waits for the data: whoever pauses wants to look at the trace.
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
