#include "actions/trace_scope.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <string.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "actions/trace_overhead.hpp"
#include "launcher/base/diagnostic.hpp"
#include "tracing/session/buffer_estimate.hpp"
#include "tracing/session/installed_program.hpp"
#include "tracing/session/loss_account.hpp"
#include "tracing/session/preload.hpp"
#include "tracing/session/session_daemon.hpp"

namespace launch {

namespace {

// After the start of a launch; no more than a guess, on which only the duration of the end depends.
constexpr std::chrono::milliseconds kNodesHaveRegistered{500};

// By the process's label, or by the name of its node.
bool matches(const std::string& pattern, const ProcessSpec& spec) {
  const auto is_meant = [&pattern](const std::string& name) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  };
  return is_meant(spec.name) || std::any_of(spec.other_names.begin(), spec.other_names.end(), is_meant);
}

std::vector<std::string> channel_names(const tracing::TraceConfig& config) {
  std::vector<std::string> names;
  for (const tracing::ChannelConfig& channel : config.channels) {
    names.push_back(channel.name);
  }
  return names;
}

bool may_block(const tracing::TraceConfig& config) {
  return config.blocking_timeout_ust != 0 ||
         std::any_of(config.channels.begin(), config.channels.end(),
                     [](const tracing::ChannelConfig& channel) { return channel.blocking_timeout != 0; });
}

// Of the stack (docs/tracetools.md): it looks at the times itself and fires nothing else.
constexpr const char* kLateCallback = "ros2_deadline:callback";
constexpr const char* kLateMessage = "ros2_deadline:message";
constexpr double kNanosecondsPerMillisecond = 1e6;

std::string nanoseconds_of(double milliseconds) {
  return fmt::format("{:.0f}", milliseconds * kNanosecondsPerMillisecond);
}

// Why a snapshot was taken, for people.
std::string reason(const TraceChoices& choices, const std::string& rule) {
  if (rule == kLateCallback && choices.callback_deadline != 0) {
    return fmt::format("a callback took more than {} ms", choices.callback_deadline);
  }
  if (rule == kLateMessage && choices.message_deadline != 0) {
    return fmt::format("a message was taken after more than {} ms", choices.message_deadline);
  }
  return "event " + rule;
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
  tracing::PreloadPlan plan = tracing::plan_preload(config_.events_ust);
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

void TraceScope::expect(const std::vector<ProcessSpec>& processes) {
  const auto traced = static_cast<std::size_t>(
      std::count_if(processes.begin(), processes.end(), [this](const ProcessSpec& spec) { return traces(spec); }));
  const auto processors = static_cast<std::size_t>(::get_nprocs_conf());
  if (choices_.auto_buffers) {
    config_.subbuffer_size_ust = tracing::sufficient_subbuffer_size(config_, traced, processors);
  }
  if (std::string warning = tracing::buffer_warning(config_, traced, processors); !warning.empty()) {
    setup_.warnings.push_back(std::move(warning));
  }
  for (const std::string& pattern : choices_.nodes.value_or(std::vector<std::string>())) {
    if (std::none_of(processes.begin(), processes.end(),
                     [&](const ProcessSpec& spec) { return matches(pattern, spec); })) {
      setup_.warnings.push_back(
          fmt::format("nothing that is launched now is called '{}', which 'nodes' names", pattern));
    }
  }
}

void TraceScope::begin(EventLoop& loop, Tell tell, Completion done) {
  if (choices_.snapshot_on_signal != 0) {
    // Before any thread is started: the signal must be blocked in all of them.
    signals_ = loop.on_signal({choices_.snapshot_on_signal}, [this](int signal) {
      if (flight_recorder_) {
        flight_recorder_->request(fmt::format("SIG{}", ::sigabbrev_np(signal)));
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
        } catch (const tracing::TraceError& error) {
          throw LaunchError(fmt::format("tracing setup failed: {}", error.what()), origin_, error.remedy());
        }
      },
      [this, &loop, tell, done = std::move(done)](std::exception_ptr error) {
        if (!error && choices_.flight_recorder()) {
          try {
            start_flight_recorder(loop, tell);
          } catch (const tracing::TraceError& failure) {
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
          flush_metadata_later(loop);
        }
        done(error);
      });
}

// Leaves no session behind when it fails.
void TraceScope::guard_overhead(EventLoop& loop, const Tell& tell) {
  if (config_.max_overhead == 0) {
    return;
  }
  try {
    overhead_guard_ = watch_overhead(config_, prefix_, loop, tell);
  } catch (const tracing::TraceError&) {
    tracer_->finish(config_, [] { return true; });
    throw;
  }
}

// Saves 200 ms at the end of every launch that takes longer than this (tracing/launch_provider/trace_probe.c).
void TraceScope::flush_metadata_later(EventLoop& loop) {
  if (config_.events_ust.empty()) {
    return;
  }
  metadata_flush_ = loop.after(kNodesHaveRegistered, [this, &loop] {
    in_background(
        loop, [this] { tracing::program_output(prefix_ + "/lib/launch/launch-trace-probe", {}); },
        [](std::exception_ptr) {});
  });
}

// Called on the loop's thread; what it registers takes the session daemon a millisecond.
void TraceScope::start_flight_recorder(EventLoop& loop, const Tell& tell) {
  flight_recorder_ =
      std::make_unique<tracing::FlightRecorder>(config_, [&loop, tell](const tracing::TakenSnapshot& taken) {
        loop.post([tell, taken] {
          const std::string reasons = fmt::format("{}", fmt::join(taken.reasons, ", "));
          if (taken.error.empty()) {
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
  metadata_flush_.reset();
  in_background(
      loop,
      [this] {
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
          summary_ =
              tracing::program_output(prefix_ + "/lib/launch/launch-report", {"--summary", config_.trace_directory()});
        }
      },
      [this, tell = std::move(tell), done = std::move(done)](std::exception_ptr error) {
        if (!error) {
          tell_result(tell);
          if (config_.fail_on_loss && !losses_.complete()) {
            error = std::make_exception_ptr(
                LaunchError(fmt::format("the trace of session '{}' is incomplete", config_.lttng_session_name()),
                            origin_, "use larger sub-buffers, record fewer events, or leave out fail-on-loss"));
          }
        }
        done(error);
      });
}

void TraceScope::tell_result(const Tell& tell) const {
  tell(false,
       fmt::format("trace written to: {}{}", config_.destination(), summary_.empty() ? "" : " (" + summary_ + ")"));
  if (!config_.records_snapshots()) {
    tell(!losses_.complete(), fmt::format("trace is {}: {}", losses_.complete() ? "complete" : "incomplete",
                                          tracing::describe_losses(losses_)));
  }
  if (const std::string cost = tracing::describe_cost(losses_); !cost.empty()) {
    tell(false, cost);
  }
  if (!losses_.unwritten_verdict.empty()) {
    tell(true, losses_.unwritten_verdict);
  }
}

std::vector<std::string> TraceScope::clean_up_command() {
  // Whoever asks is going to run this: a dry run makes no directory.
  counters_ = tracing::EventCounterDirectory::shared();
  config_.event_counters = counters_ ? counters_->path().string() : "";
  // It is told before the session is created: one that has the name already is somebody else's.
  std::vector<std::string> command = {prefix_ + "/bin/launch", "trace", "stop", config_.lttng_session_name(),
                                      fmt::format("--created-since={}", created_)};
  if (counters_) {
    command.insert(command.end(), {"--event-counters", counters_->path().string()});
  }
  return command;
}

bool TraceScope::traces(const ProcessSpec& spec) const {
  return spec.traced &&
         (!choices_.nodes || std::any_of(choices_.nodes->begin(), choices_.nodes->end(),
                                         [&](const std::string& pattern) { return matches(pattern, spec); }));
}

void TraceScope::prepare(ProcessSpec& spec) const {
  if (!traces(spec)) {
    std::string& variable = spec.environment["LD_PRELOAD"];
    const std::string library = prefix_ + "/lib/launch/liblaunch_untraced.so";
    if (variable.find(library) == std::string::npos) {
      variable = tracing::append_preload(variable, {library});
    }
    // There is nothing to wait for.
    spec.environment.emplace("LTTNG_UST_REGISTER_TIMEOUT", "0");
    return;
  }
  if (!tracing::session_daemon_can_answer()) {
    // It would wait for three seconds, three times, before its main().
    spec.environment.emplace("LTTNG_UST_REGISTER_TIMEOUT", "0");
  }
  if (!preload_.empty()) {
    std::string& variable = spec.environment["LD_PRELOAD"];
    variable = tracing::append_preload(variable, preload_);
  }
  if (counters_) {
    spec.environment.emplace(tracing::kEventCountersVariable, counters_->path().string());
  }
  if (choices_.callback_deadline != 0) {
    spec.environment.emplace("TRACETOOLS_CALLBACK_DEADLINE", nanoseconds_of(choices_.callback_deadline));
  }
  if (choices_.message_deadline != 0) {
    spec.environment.emplace("TRACETOOLS_MESSAGE_DEADLINE", nanoseconds_of(choices_.message_deadline));
  }
  if (may_block(config_)) {
    spec.environment.emplace("LTTNG_UST_ALLOW_BLOCKING", "1");
  }
}

std::vector<ScopeSetting> TraceScope::describe() const {
  return {{"session-name", config_.session_name},
          {"trace-directory", config_.trace_directory()},
          {"append-trace", config_.append_trace},
          {"fail-on-loss", config_.fail_on_loss},
          {"events-ust", config_.events_ust},
          {"events-kernel", config_.events_kernel},
          {"syscalls", config_.syscalls},
          {"channels", channel_names(config_)},
          {"context-fields", config_.context_fields_ust},
          {"context-fields-kernel", config_.context_fields_kernel},
          {"subbuffer-size-ust", static_cast<std::int64_t>(config_.subbuffer_size_ust)},
          {"init-channel", config_.init_channel},
          {"subbuffer-count-ust", static_cast<std::int64_t>(config_.subbuffer_count_ust)},
          {"read-timer-ust", static_cast<std::int64_t>(config_.read_timer_ust)},
          {"switch-timer-ust", static_cast<std::int64_t>(config_.switch_timer_ust)},
          {"overwrite-ust", config_.overwrite_ust.value_or(config_.records_snapshots())},
          {"blocking-timeout-ust", config_.blocking_timeout_ust},
          {"buffers-ust", std::string(config_.buffers_ust == tracing::BufferOwner::kProcess ? "pid" : "uid")},
          {"tracefile-size", static_cast<std::int64_t>(config_.tracefile_size)},
          {"tracefile-count", static_cast<std::int64_t>(config_.tracefile_count)},
          {"url", config_.over_network() ? config_.destination() : std::string()},
          {"live-timer", static_cast<std::int64_t>(config_.live_timer)},
          {"launch-events", config_.launch_events},
          {"subbuffer-size-kernel", static_cast<std::int64_t>(config_.subbuffer_size_kernel)},
          {"snapshot-mode", config_.snapshot_mode},
          {"snapshot-on-crash", choices_.snapshot_on_crash},
          {"snapshot-on-events", choices_.snapshot_on_events},
          {"snapshot-on-late-callback", fmt::format("{}", choices_.callback_deadline)},
          {"snapshot-on-late-message", fmt::format("{}", choices_.message_deadline)},
          {"snapshot-limit", static_cast<std::int64_t>(config_.snapshot_limit)},
          {"max-overhead", config_.max_overhead == 0 ? "" : fmt::format("{:g}%", 100 * config_.max_overhead)},
          {"drop-order", config_.drop_order},
          {"dual-session", config_.dual_session}};
}

std::vector<TimedStep> TraceScope::timing() const {
  std::vector<TimedStep> steps;
  for (const tracing::SetupStep& step : setup_.steps) {
    steps.push_back({"trace: " + step.name, step.took});
  }
  return steps;
}

}  // namespace launch
