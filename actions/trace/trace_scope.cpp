// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_scope.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "actions/trace/trace_overhead.hpp"
#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/session_step.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/plan/preload.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

namespace {

// Time after the start of a launch. It is a guess, and only the duration of the end depends on it.
constexpr std::chrono::milliseconds kNodesHaveRegistered{500};
// To describe a complete trace in one line, up to this many bytes are read: a tenth of a second.
constexpr std::uint64_t kLargestSummarized = 100'000'000;

// An event of the stack (docs/tracetools.md): the stack compares the times itself and fires only this.
constexpr const char* kLateCallback = "ros2_deadline:callback";
constexpr const char* kLateMessage = "ros2_deadline:message";
// The reason for a snapshot, for people.
std::string reason(const TraceChoices& choices, const std::string& rule) {
  if (rule == kLateCallback && choices.callback_deadline != 0) {
    return fmt::format("a callback took more than {} ms", choices.callback_deadline);
  }
  if (rule == kLateMessage && choices.message_deadline != 0) {
    return fmt::format("a message was taken after more than {} ms", choices.message_deadline);
  }
  return "event " + rule;
}

// The names of the events whose rules are among the reasons.
std::vector<std::string> late_events(const TraceChoices& choices, const std::vector<std::string>& reasons) {
  std::vector<std::string> names;
  for (const std::string& rule : choices.watched_events()) {
    if (std::find(reasons.begin(), reasons.end(), reason(choices, rule)) != reasons.end()) {
      names.push_back(rule.substr(0, rule.find(' ')));
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> TraceChoices::watched_events() const {
  std::vector<std::string> rules = snapshot_on_events;
  if (callback_deadline != 0) {
    rules.emplace_back(kLateCallback);
  }
  if (message_deadline != 0) {
    rules.emplace_back(kLateMessage);
  }
  return rules;
}

TraceScope::TraceScope(tracing::TraceConfig config, std::unique_ptr<tracing::Tracer> tracer, std::string prefix,
                       SourceRange origin, TraceChoices choices)
    : config_(std::move(config)),
      tracer_(std::move(tracer)),
      prefix_(std::move(prefix)),
      origin_(std::move(origin)),
      choices_(std::move(choices)),
      created_(std::time(nullptr)) {
  for (const auto& [deadline, event] :
       {std::pair(choices_.callback_deadline, kLateCallback), std::pair(choices_.message_deadline, kLateMessage)}) {
    if (deadline != 0) {
      config_.further_events_ust.emplace_back(event);
    }
  }
  tracing::PreloadPlan plan = tracing::plan_preload(config_.all_events_ust());
  preload_ = std::move(plan.libraries);
  setup_.warnings = std::move(plan.warnings);
}

TraceScope::~TraceScope() {
  if (worker_.joinable()) {
    worker_.join();
  }
}

void TraceScope::in_background(EventLoop& loop, std::function<void()> work,
                               std::function<void(std::exception_ptr)> finished) {
  if (worker_.joinable()) {
    worker_.join();
  }
  worker_ = std::thread([&loop, work = std::move(work), finished = std::move(finished)] {
    std::exception_ptr error;
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    loop.post([finished, error] { finished(error); });
  });
}

void TraceScope::begin(EventLoop& loop, Tell tell, Completion done) {
  if (choices_.snapshot_on_signal != 0) {
    // Before any thread is started, because the signal must be blocked in all threads.
    signals_ = loop.on_signal({choices_.snapshot_on_signal}, [this](EventLoop::Signal signal) {
      if (flight_recorder_) {
        flight_recorder_->request(fmt::format("SIG{}", ::sigabbrev_np(signal.number)));
      }
    });
  }
  in_background(
      loop,
      [this, &loop, tell] {
        try {
          const std::vector<std::string> warnings = std::move(setup_.warnings);
          setup_ = tracer_->start(config_);
          guard_overhead(loop, tell);
          setup_.warnings.insert(setup_.warnings.begin(), warnings.begin(), warnings.end());
          if (const std::string problem = write_chains(); !problem.empty()) {
            setup_.warnings.push_back(problem);
          }
        } catch (const tracing::TraceError& error) {
          throw LaunchError(fmt::format("tracing setup failed: {}", error.what()), origin_, error.remedy());
        }
      },
      [this, &loop, tell, done = std::move(done)](std::exception_ptr error) {
        if (!error && choices_.flight_recorder()) {
          try {
            start_flight_recorder(loop, tell);
          } catch (const tracing::TraceError& failure) {
            end_failed_session();
            error = std::make_exception_ptr(
                LaunchError(fmt::format("tracing setup failed: {}", failure.what()), origin_, failure.remedy()));
          }
        }
        if (!error) {
          for (const std::string& warning : setup_.warnings) {
            tell(true, warning);
          }
          if (!setup_.notes.empty()) {
            tell(false, setup_.notes);
          }
          tell(false, fmt::format("writing tracing session to: {}", setup_.trace_directory));
          run_watch_ = tracer_->watch(config_, [&loop, tell](const std::string& sentence) {
            loop.post([tell, sentence] { tell(true, sentence); });
          });
          look_around_later(loop, tell);
        }
        done(error);
      });
}

// Ends the session if this fails.
void TraceScope::guard_overhead(EventLoop& loop, const Tell& tell) {
  if (config_.max_overhead == 0) {
    return;
  }
  try {
    overhead_guard_ = watch_overhead(config_, prefix_, loop, tell);
  } catch (const tracing::TraceError&) {
    end_failed_session();
    throw;
  }
}

void TraceScope::end_failed_session() {
  overhead_guard_.reset();
  flight_recorder_.reset();
  try {
    tracer_->finish(config_, [] { return true; });
  } catch (const tracing::TraceError&) {
    // The error of the setup counts.
  }
}

std::string TraceScope::write_chains() const {
  if (choices_.chains.empty() || config_.over_network()) {
    return "";
  }
  try {
    tracing::write_chains(choices_.chains, std::filesystem::path(config_.base_path) / config_.session_name);
    return "";
  } catch (const std::system_error& error) {
    return fmt::format("the report will not know the chains of the launch file: {}", error.what());
  }
}

// Saves 200 ms at the end of every launch that takes longer than this (programs/trace_probe/trace_probe.c). It also
// warns of programs that can't be recorded, for which it searches all of /proc.
void TraceScope::look_around_later(EventLoop& loop, const Tell& tell) {
  if (config_.events_ust.empty()) {
    return;
  }
  look_around_ = loop.after(kNodesHaveRegistered, [this, &loop, tell] {
    in_background(
        loop,
        [this, &loop, tell] {
          tracing::program_output(prefix_ + "/lib/launch/launch-trace-probe", {});
          for (const std::string& warning : tracer_->unreachable_processes()) {
            loop.post([tell, warning] { tell(true, warning); });
          }
        },
        [](std::exception_ptr) {});
  });
}

// Called on the thread of the loop. The session daemon takes a millisecond for these registrations.
void TraceScope::start_flight_recorder(EventLoop& loop, const Tell& tell) {
  flight_recorder_ = std::make_unique<tracing::FlightRecorder>(
      config_, [&loop, tell, observer = snapshot_observer_, choices = choices_](const tracing::TakenSnapshot& taken) {
        loop.post([tell, taken, observer, late = late_events(choices, taken.reasons)] {
          const std::string reasons = fmt::format("{}", fmt::join(taken.reasons, ", "));
          if (taken.error.empty()) {
            if (observer) {
              observer(taken.reasons, taken.directory.string(), late);
            }
            tell(false, fmt::format("snapshot written to: {} ({})", taken.directory.string(), reasons));
          } else {
            tell(true, fmt::format("no snapshot ({}): {}", reasons, taken.error));
          }
        });
      });
  if (const std::vector<std::string> rules = choices_.watched_events(); !rules.empty()) {
    event_watch_ = std::make_unique<tracing::EventWatch>(
        config_.lttng_session_name(), rules,
        [this](const std::string& rule) { flight_recorder_->request(reason(choices_, rule)); });
  }
}

void TraceScope::record(const LaunchRecord& record) {
  if (!choices_.snapshot_on_crash || !flight_recorder_ || record.kind != LaunchRecord::Kind::kExit ||
      record.value == 0 || record.asked_for) {
    return;
  }
  flight_recorder_->request(record.value < 0
                                ? fmt::format("{} died of SIG{}", record.name, ::sigabbrev_np(-record.value))
                                : fmt::format("{} ended with exit code {}", record.name, record.value));
}

void TraceScope::end(EventLoop& loop, Tell tell, Completion done) {
  signals_.reset();
  look_around_.reset();
  in_background(
      loop,
      [this] {
        run_watch_.reset();
        overhead_guard_.reset();
        event_watch_.reset();
        flight_recorder_.reset();
        try {
          losses_ = tracer_->finish(config_, [this] { return hurry_.load(); });
        } catch (const tracing::TraceError& error) {
          throw LaunchError(
              fmt::format("tracing session '{}' could not be finished: {}", config_.lttng_session_name(), error.what()),
              origin_, error.remedy());
        }
        if (!config_.records_snapshots() && !config_.over_network() && !hurry_) {
          summarize();
        }
        if (choices_.report && !config_.over_network() && !hurry_) {
          make_report();
        }
      },
      [this, tell = std::move(tell), done = std::move(done)](std::exception_ptr error) {
        if (!error) {
          tell_result(tell);
          if (config_.fail_on_loss && losses_.has_losses()) {
            error = std::make_exception_ptr(
                LaunchError(fmt::format("the trace of session '{}' is incomplete", config_.lttng_session_name()),
                            origin_, "use larger sub-buffers, record fewer events, or leave out fail-on-loss"));
          }
        }
        done(error);
      });
}

void TraceScope::summarize() {
  std::uint64_t bytes = 0;
  for (const tracing::ChannelLoss& channel : losses_.channels) {
    bytes += channel.bytes;
  }
  if (losses_.complete() && bytes > kLargestSummarized) {
    summary_ = fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
    return;
  }
  const auto before = std::chrono::steady_clock::now();
  summary_ = tracing::program_output(prefix_ + "/lib/launch/launch-report", {"--summary", config_.trace_directory()});
  losses_.steps.push_back({"summary", std::chrono::steady_clock::now() - before});
}

void TraceScope::make_report() {
  const std::filesystem::path page = std::filesystem::path(config_.trace_directory()) / "report.html";
  std::error_code failed;
  std::filesystem::remove(page, failed);  // of an earlier launch with append-trace
  const auto before = std::chrono::steady_clock::now();
  tracing::program_output(prefix_ + "/lib/launch/launch-report", {config_.trace_directory(), "--html", page.string()});
  // A damaged trace has a page, too, although the program fails.
  report_ = std::filesystem::exists(page, failed) ? page.string() : "";
  losses_.steps.push_back({"report", std::chrono::steady_clock::now() - before});
}

void TraceScope::tell_result(const Tell& tell) const {
  tell(false,
       fmt::format("trace written to: {}{}", config_.destination(), summary_.empty() ? "" : " (" + summary_ + ")"));
  if (!config_.records_snapshots()) {
    tell(losses_.has_losses() || !losses_.absences.empty(),
         fmt::format("trace is {}: {}", losses_.complete() ? "complete" : "incomplete",
                     tracing::describe_losses(losses_)));
  }
  if (const std::string cost = tracing::describe_cost(losses_); !cost.empty()) {
    tell(false, cost);
  }
  if (!losses_.unwritten_verdict.empty()) {
    tell(true, losses_.unwritten_verdict);
  }
  if (!report_.empty()) {
    tell(false, "report: " + report_);
  } else if (choices_.report) {
    tell(true, "no report: " + (config_.over_network() ? "the trace is on another machine"
                                : hurry_               ? "the launch was to end at once"
                                         : fmt::format("see what 'launch report {}' says", config_.trace_directory())));
  } else if (!config_.over_network() && !config_.records_snapshots()) {
    tell(false, fmt::format("what is in it: launch report {}", config_.trace_directory()));
  }
}

std::vector<std::string> TraceScope::clean_up_command() {
  // Only a real run asks for this command, so a dry run makes no directory.
  counters_ = tracing::CounterDirectory::shared();
  config_.event_counters = counters_ ? counters_->path().string() : "";
  // The command is chosen before the session is created. A session that has the name already belongs to somebody else.
  std::vector<std::string> command = {prefix_ + "/bin/launch", "trace", "stop", config_.lttng_session_name(),
                                      fmt::format("--created-since={}", created_)};
  if (counters_) {
    command.insert(command.end(), {"--event-counters", counters_->path().string()});
  }
  return command;
}

std::vector<TimedStep> TraceScope::timing() const {
  const bool ended = !losses_.steps.empty();
  std::vector<TimedStep> steps;
  for (const tracing::SessionStep& step : ended ? losses_.steps : setup_.steps) {
    steps.push_back({(ended ? "trace end: " : "trace: ") + step.name, step.took});
  }
  return steps;
}

}  // namespace launch
