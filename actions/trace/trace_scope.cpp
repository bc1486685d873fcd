// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_scope.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

namespace {

// Time after the start of a launch. It is a guess, and only the duration of the end depends on it.
constexpr std::chrono::milliseconds kNodesHaveRegistered{500};

// Tells on the thread of the loop, from any thread.
RunScope::Tell on_loop(EventLoop& loop, const RunScope::Tell& tell) {
  return [&loop, tell](bool warning, const std::string& text) {
    loop.post([tell, warning, text] { tell(warning, text); });
  };
}

}  // namespace

TraceScope::TraceScope(TraceRequest request, std::unique_ptr<tracing::Tracer> tracer, std::string prefix,
                       SourceRange origin)
    : origin_(std::move(origin)),
      choices_(std::move(request.choices)),
      run_(std::move(request.config), std::move(tracer), std::move(prefix), choices_),
      processes_(run_, choices_) {
  block_snapshot_signal(choices_);
}

void block_snapshot_signal(const TraceChoices& choices) {
  if (choices.snapshot_on_signal != 0) {
    sigset_t signal;
    ::sigemptyset(&signal);
    ::sigaddset(&signal, choices.snapshot_on_signal);
    ::pthread_sigmask(SIG_BLOCK, &signal, nullptr);
  }
}

TraceScope::~TraceScope() {
  for (std::thread* const thread : {&worker_, &snapshot_worker_}) {
    if (thread->joinable()) {
      thread->join();
    }
  }
}

void TraceScope::take_part_of_snapshot(EventLoop& loop, tracing::SnapshotOrder order,
                                       std::function<void(const tracing::TakenSnapshot&)> done) {
  if (snapshot_worker_.joinable()) {
    snapshot_worker_.join();
  }
  snapshot_worker_ = std::thread([this, &loop, order = std::move(order), done = std::move(done)]() mutable {
    const tracing::TakenSnapshot taken = run_.take_snapshot(std::move(order));
    loop.post([done = std::move(done), taken] { done(taken); });
  });
}

void TraceScope::in_background(EventLoop& loop, std::string context, std::function<void()> work, Completion finished) {
  if (worker_.joinable()) {
    worker_.join();
  }
  worker_ =
      std::thread([this, &loop, context = std::move(context), work = std::move(work), finished = std::move(finished)] {
        std::exception_ptr error;
        try {
          work();
        } catch (const tracing::TraceError& failure) {
          error = std::make_exception_ptr(LaunchError(context + failure.what(), origin_, failure.remedy()));
        } catch (...) {
          error = std::current_exception();
        }
        loop.post([finished, error] { finished(error); });
      });
}

void TraceScope::begin(EventLoop& loop, Tell tell, Completion done) {
  tell_ = tell;
  if (choices_.snapshot_on_signal != 0) {
    signals_ = loop.on_signal({choices_.snapshot_on_signal}, [this](EventLoop::Signal signal) {
      run_.request_snapshot(fmt::format("SIG{}", ::sigabbrev_np(signal.number)));
    });
  }
  const Tell told = on_loop(loop, tell);
  const auto observe = [&loop, observer = snapshot_observer_](const tracing::TakenSnapshot& taken,
                                                              const std::vector<std::string>& late) {
    if (observer) {
      loop.post([observer, taken, late] { observer(taken.reasons, taken.directory.string(), late); });
    }
  };
  in_background(
      loop, "tracing setup failed: ",
      [this, told, observe, refused = processes_.refused()] {
        if (refused) {
          throw tracing::TraceError(*refused, "use tracetools=\"auto\", or trace=\"false\" for the process");
        }
        run_.start(told, observe);
      },
      [this, &loop, told, done = std::move(done)](std::exception_ptr error) {
        if (!error && !run_.config().events_ust.empty()) {
          look_around_ = loop.after(kNodesHaveRegistered, [this, &loop, told] {
            in_background(
                loop, "", [this, told] { run_.look_around(told); }, [](std::exception_ptr) {});
          });
        }
        done(error);
      });
}

void TraceScope::prepare(ProcessSpec& spec) const {
  if (!spec.machine.empty()) {
    return;  // its agent prepares it
  }
  processes_.prepare(spec, [this](const std::string& warning) {
    if (tell_) {
      tell_(true, warning);
    }
  });
}

void TraceScope::record(const LaunchRecord& record) {
  if (record.kind == LaunchRecord::Kind::kExec) {
    run_.process_started(record.pid);
  }
  if (record.kind != LaunchRecord::Kind::kExit) {
    return;
  }
  // Whatever it ended of: at an exit() other threads may be within an event, and a shell tells the death of its child
  // by an exit code.
  run_.process_ended(record.name, record.pid, record.value != 0);
  if (choices_.snapshot_on_crash && !leaves_snapshots_ && record.value != 0 && !record.asked_for) {
    run_.request_snapshot(end_as_reason(record.name, record.value), record.name);
  }
}

std::string end_as_reason(const std::string& process, std::int32_t code) {
  const char* const signal = code < 0 ? ::sigabbrev_np(-code) : nullptr;
  return signal != nullptr ? fmt::format("{} died of SIG{}", process, signal)
         : code < 0        ? fmt::format("{} died of signal {}", process, -code)
                           : fmt::format("{} ended with exit code {}", process, code);
}

void TraceScope::end(EventLoop& loop, Tell tell, Completion done) {
  signals_.reset();
  look_around_.reset();
  run_.config().tracetools = processes_.uses();
  in_background(
      loop, "", [this, told = on_loop(loop, tell)] { run_.finish(told); }, std::move(done));
}

std::vector<TimedStep> TraceScope::timing() const {
  std::vector<TimedStep> steps;
  for (const tracing::SessionStep& step : run_.steps()) {
    steps.push_back({(run_.finished() ? "trace end: " : "trace: ") + step.name, step.took});
  }
  return steps;
}

}  // namespace launch
