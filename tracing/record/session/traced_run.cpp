// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/traced_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/monotonic_clock.hpp"
#include "base/text/quoted_text.hpp"
#include "tracing/record/account/counters/launch_processes.hpp"
#include "tracing/record/account/counters/process_ends.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/plan/preload.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/free_name.hpp"
#include "tracing/record/session/overhead_watch.hpp"

namespace tracing {

namespace {

// To describe a complete trace in one line, up to this many bytes are read: a tenth of a second.
constexpr std::uint64_t kLargestSummarized = 100'000'000;

// An event of the stack (docs/tracetools.md): the stack compares the times itself and fires only this.
constexpr const char* kLateCallback = "ros2_deadline:callback";
constexpr const char* kLateMessage = "ros2_deadline:message";
// The reason for a snapshot, for people.
std::string snapshot_reason(const RunChoices& choices, const std::string& rule) {
  if (rule == kLateCallback && choices.callback_deadline != 0) {
    return fmt::format("a callback took more than {} ms", choices.callback_deadline);
  }
  if (rule == kLateMessage && choices.message_deadline != 0) {
    return fmt::format("a message was taken after more than {} ms", choices.message_deadline);
  }
  return "event " + rule;
}

}  // namespace

std::vector<std::string> late_events(const RunChoices& choices, const std::vector<std::string>& reasons) {
  std::vector<std::string> names;
  for (const std::string& rule : choices.watched_events()) {
    if (std::find(reasons.begin(), reasons.end(), snapshot_reason(choices, rule)) != reasons.end()) {
      names.push_back(rule.substr(0, rule.find(' ')));
    }
  }
  return names;
}

std::vector<std::string> reasons_by_events(const RunChoices& choices) {
  std::vector<std::string> reasons;
  for (const std::string& rule : choices.watched_events()) {
    reasons.push_back(snapshot_reason(choices, rule));
  }
  return reasons;
}

std::vector<std::string> RunChoices::watched_events() const {
  std::vector<std::string> rules = snapshot_on_events;
  if (callback_deadline != 0) {
    rules.emplace_back(kLateCallback);
  }
  if (message_deadline != 0) {
    rules.emplace_back(kLateMessage);
  }
  return rules;
}

TracedRun::TracedRun(TraceConfig config, std::unique_ptr<Tracer> tracer, std::string prefix, RunChoices choices)
    : config_(std::move(config)),
      tracer_(std::move(tracer)),
      prefix_(std::move(prefix)),
      choices_(std::move(choices)),
      created_(std::time(nullptr)) {
  for (const auto& [deadline, event] :
       {std::pair(choices_.callback_deadline, kLateCallback), std::pair(choices_.message_deadline, kLateMessage)}) {
    if (deadline != 0) {
      config_.further_events_ust.emplace_back(event);
    }
  }
  PreloadPlan plan = plan_preload(config_.all_events_ust());
  preload_ = std::move(plan.libraries);
  setup_.warnings = std::move(plan.warnings);
}

std::vector<std::string> TracedRun::clean_up_command() {
  name_ = claim_free_name(config_);
  counters_ = CounterDirectory::shared();
  config_.event_counters = counters_ ? counters_->path().string() : "";
  // The command is chosen before the session is created. A session that has the name already belongs to somebody else.
  std::vector<std::string> command = {prefix_ + "/bin/launch", "trace", "stop", config_.lttng_session_name(),
                                      fmt::format("--created-since={}", created_)};
  if (counters_) {
    command.insert(command.end(), {"--event-counters", counters_->path().string()});
  }
  return command;
}

void TracedRun::start(const Tell& tell, const SnapshotObserver& observer) {
  const std::vector<std::string> warnings = std::move(setup_.warnings);
  note_launch_processes(config_.event_counters, related_processes());
  setup_ = tracer_->start(config_);
  try {
    if (config_.max_overhead != 0) {
      overhead_guard_ = watch_overhead(config_, prefix_, tell);
    }
    if (choices_.flight_recorder()) {
      start_flight_recorder(tell, observer);
    }
  } catch (const TraceError&) {
    end_failed_session();
    throw;
  }
  setup_.warnings.insert(setup_.warnings.begin(), warnings.begin(), warnings.end());
  if (const std::string problem = write_chains(); !problem.empty()) {
    setup_.warnings.push_back(problem);
  }
  for (const std::string& warning : setup_.warnings) {
    tell(true, warning);
  }
  if (!setup_.notes.empty()) {
    tell(false, setup_.notes);
  }
  tell(false, fmt::format("writing tracing session to: {}", setup_.trace_directory));
  std::unique_ptr<RunWatch> watch =
      tracer_->watch(config_, [tell](const std::string& sentence) { tell(true, sentence); });
  const std::lock_guard lock(watchers_mutex_);
  run_watch_ = std::move(watch);
}

void TracedRun::end_failed_session() {
  overhead_guard_.reset();
  stop_flight_recorder();
  try {
    tracer_->finish(config_, [] { return true; });
  } catch (const TraceError&) {
    // The error of the setup counts.
  }
}

std::string TracedRun::write_chains() const {
  if (choices_.chains.empty() || config_.over_network() || (config_.records_snapshots() && wish_)) {
    return "";
  }
  try {
    tracing::write_chains(choices_.chains,
                          std::filesystem::path(config_.base_path) / config_.session_name / config_.part);
    return "";
  } catch (const std::system_error& error) {
    return fmt::format("the report will not know the chains of the launch file: {}", error.what());
  }
}

void TracedRun::look_around(const Tell& tell) {
  note_launch_processes(config_.event_counters, related_processes());
  // In a session with buffers for each process it would have a trace of its own, for nothing.
  if (config_.buffers_ust != BufferOwner::kProcess) {
    run_traced(prefix_ + "/lib/launch/launch-trace-probe");
  }
  for (const std::string& warning : tracer_->unreachable_processes()) {
    tell(true, warning);
  }
}

// The session daemon takes a millisecond for these registrations.
void TracedRun::start_flight_recorder(const Tell& tell, const SnapshotObserver& observer) {
  std::shared_ptr<FlightRecorder> recorder;
  if (!wish_) {
    recorder =
        std::make_shared<FlightRecorder>(config_, [tell, observer, choices = choices_](const TakenSnapshot& taken) {
          const std::string reasons = fmt::format("{}", fmt::join(taken.reasons, ", "));
          if (!taken.error.empty()) {
            tell(true, fmt::format("no snapshot ({}): {}", reasons, taken.error));
            return;
          }
          if (observer) {
            observer(taken, late_events(choices, taken.reasons));
          }
          tell(false, fmt::format("snapshot written to: {} ({})", taken.directory.string(), reasons));
          if (!taken.damage.empty()) {
            tell(true, fmt::format("the snapshot is incomplete: {}", taken.damage));
          }
        });
  }
  if (const std::vector<std::string> rules = choices_.watched_events(); !rules.empty()) {
    event_watch_ = std::make_unique<EventWatch>(config_.lttng_session_name(), rules, [this](const std::string& rule) {
      request_snapshot(snapshot_reason(choices_, rule));
    });
  }
  const std::lock_guard lock(watchers_mutex_);
  flight_recorder_ = std::move(recorder);
}

// The recorder takes what was requested before it ends, without the lock.
void TracedRun::stop_flight_recorder() {
  event_watch_.reset();
  std::shared_ptr<FlightRecorder> recorder;
  const std::lock_guard lock(watchers_mutex_);
  recorder.swap(flight_recorder_);
}

void TracedRun::request_snapshot(const std::string& reason, const std::string& died) {
  if (wish_) {
    wish_(reason, died);
    return;
  }
  const std::lock_guard lock(watchers_mutex_);
  if (flight_recorder_) {
    flight_recorder_->request(reason, died);
  }
}

void TracedRun::process_started(pid_t pid) {
  note_launch_processes(config_.event_counters, {pid});
}

void TracedRun::process_ended(const std::string& name, pid_t pid, bool died) {
  if (config_.buffers_ust == BufferOwner::kProcess) {
    note_process_end(config_.event_counters, pid, static_cast<std::uint64_t>(launch::monotonic_time()), died);
  }
  const std::lock_guard lock(watchers_mutex_);
  if (run_watch_) {
    run_watch_->process_ended(name);
  }
}

// What it tells at last is told without the lock.
void TracedRun::stop_run_watch() {
  std::unique_ptr<RunWatch> watch;
  const std::lock_guard lock(watchers_mutex_);
  watch.swap(run_watch_);
}

void TracedRun::finish(const Tell& tell) {
  stop_run_watch();
  overhead_guard_.reset();
  stop_flight_recorder();
  try {
    losses_ = tracer_->finish(config_, [this] { return hurry_.load(); });
  } catch (const TraceError& error) {
    throw TraceError(
        fmt::format("tracing session '{}' could not be finished: {}", config_.lttng_session_name(), error.what()),
        error.remedy());
  }
  if (!config_.records_snapshots() && !config_.over_network() && !hurry_) {
    summarize();
  }
  if (choices_.report && !config_.over_network() && !hurry_ && config_.part.empty()) {
    make_report();
  }
  tell_result(tell);
  if (config_.fail_on_loss && losses_.has_losses()) {
    throw TraceError(fmt::format("the trace of session '{}' is incomplete", config_.lttng_session_name()),
                     "use larger sub-buffers, record fewer events, or leave out fail-on-loss");
  }
}

void TracedRun::summarize() {
  std::uint64_t bytes = 0;
  for (const ChannelLoss& channel : losses_.channels) {
    bytes += channel.bytes;
  }
  if (losses_.complete() && bytes > kLargestSummarized) {
    summary_ = fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
    return;
  }
  const auto before = std::chrono::steady_clock::now();
  summary_ = program_output(prefix_ + "/lib/launch/launch-report", {"--summary", config_.trace_directory()});
  losses_.steps.push_back({"summary", std::chrono::steady_clock::now() - before});
}

void TracedRun::make_report() {
  const std::filesystem::path page = std::filesystem::path(config_.trace_directory()) / "report.html";
  std::error_code failed;
  std::filesystem::remove(page, failed);  // of an earlier launch with append-trace
  const auto before = std::chrono::steady_clock::now();
  program_output(prefix_ + "/lib/launch/launch-report", {config_.trace_directory(), "--html", page.string()});
  // A damaged trace has a page, too, although the program fails.
  report_ = std::filesystem::exists(page, failed) ? page.string() : "";
  losses_.steps.push_back({"report", std::chrono::steady_clock::now() - before});
}

// A session of snapshots writes nothing before the first one.
bool TracedRun::has_no_snapshot() const {
  if (!config_.records_snapshots() || config_.over_network()) {
    return false;
  }
  std::error_code failed;
  std::filesystem::directory_iterator entry(config_.trace_directory(), failed);
  for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
    std::error_code gone;
    if (entry->is_directory(gone)) {
      return false;
    }
  }
  return true;
}

void TracedRun::tell_result(const Tell& tell) const {
  if (config_.records_snapshots() && wish_) {
    return;  // the owner of the run has told of each snapshot
  }
  if (has_no_snapshot()) {
    tell(false, "no trace was written: no snapshot was taken");
    return;
  }
  if (losses_.wrote_nothing) {
    tell(true, fmt::format("no trace was written: {}",
                           losses_.absences.empty() ? "nothing was recorded" : describe_losses(losses_)));
    return;
  }
  tell(false,
       fmt::format("trace written to: {}{}", config_.destination(), summary_.empty() ? "" : " (" + summary_ + ")"));
  if (!config_.records_snapshots()) {
    tell(losses_.has_losses() || !losses_.absences.empty(),
         fmt::format("trace is {}: {}", describe_completeness(losses_), describe_losses(losses_)));
  }
  if (const std::string cost = describe_cost(losses_); !cost.empty()) {
    tell(false, cost);
  }
  for (const std::string& note : losses_.notes) {
    tell(true, note);
  }
  if (!losses_.unwritten_verdict.empty()) {
    tell(true, losses_.unwritten_verdict);
  }
  const std::string report_command = "launch report " + launch::shell_quoted(config_.trace_directory());
  if (!report_.empty()) {
    tell(false, "report: " + report_);
  } else if (choices_.report && config_.part.empty()) {
    tell(true, "no report: " + (config_.over_network() ? "the trace is on another machine"
                                : hurry_               ? "the launch was to end at once"
                                                       : fmt::format("see what `{}` says", report_command)));
  } else if (!config_.over_network() && !config_.records_snapshots() && config_.part.empty()) {
    tell(false, "what is in it: " + report_command);
  }
}

}  // namespace tracing
