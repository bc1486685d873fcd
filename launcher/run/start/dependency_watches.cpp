// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/dependency_watches.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>
#include <variant>

#include "base/overloaded.hpp"

namespace launch {

namespace {

// Whether the condition holds, as far as the process alone shows it; nothing when that is still open.
struct Verdict {
  bool holds = false;
  std::optional<std::string> failure;
};

Verdict judge(const ProcessCondition& condition, const TrackedProcess& process) {
  const auto failure = [&]() -> std::optional<std::string> {
    if (!process.is_over) {
      return std::nullopt;
    }
    if (!process.has_run) {
      return fmt::format("'{}' was not started", condition.process);
    }
    return fmt::format("'{}' has ended with exit code {}", condition.process, process.exit_code.value_or(0));
  };
  return std::visit(Overloaded{
                        [&](const UntilStarted&) -> Verdict {
                          return {process.has_run, process.has_run ? std::nullopt : failure()};
                        },
                        [&](const UntilExited& until) -> Verdict {
                          const bool holds = process.exit_code && until.exit_code.matches(*process.exit_code);
                          return {holds, holds ? std::nullopt : failure()};
                        },
                        [&](const UntilOutput&) -> Verdict {
                          return {false, failure()};
                        },
                        [&](const UntilHealthy&) -> Verdict {
                          return {process.is_healthy, process.is_healthy ? std::nullopt : failure()};
                        },
                    },
                    condition.state);
}

}  // namespace

class DependencyWatches::Watch {
 public:
  Watch(DependencyWatches& watches, const Dependency& of, Decided call)
      : all(watches), dependency(of), decided(std::move(call)) {}
  ~Watch() {
    if (const auto found = all.by_target_.find(dependency.target); found != all.by_target_.end()) {
      if (std::erase(found->second, this) > 0) {
        all.lines_watched_ -= until_output() != nullptr;
      }
      if (found->second.empty()) {
        all.by_target_.erase(found);
      }
    }
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  const UntilOutput* until_output() const {
    const auto* const condition = std::get_if<ProcessCondition>(&dependency.condition);
    return condition == nullptr ? nullptr : std::get_if<UntilOutput>(&condition->state);
  }
  // Compares the condition with the facts known about its process.
  void evaluate() {
    const Verdict verdict = judge(std::get<ProcessCondition>(dependency.condition), *dependency.target);
    if (verdict.holds || verdict.failure) {
      decide(verdict.failure);
    }
  }
  void on_line(OutputStream stream, std::string_view line) {
    const UntilOutput* const until = until_output();
    if (until != nullptr && !is_decided && until->pattern.matches(stream, line) && ++lines == until->occurrence) {
      decide(std::nullopt);
    }
  }
  void decide(const std::optional<std::string>& failure) {
    if (!std::exchange(is_decided, true)) {
      timer.reset();
      decided(failure);
    }
  }

  DependencyWatches& all;
  const Dependency& dependency;
  Decided decided;
  EventLoop::SourcePtr timer;
  std::uint64_t lines = 0;  // that the condition is about, so far
  bool is_decided = false;
};

DependencyWatches::WatchPtr DependencyWatches::begin(const Dependency& dependency, Decided decided) {
  const WatchPtr owner = std::make_shared<Watch>(*this, dependency, std::move(decided));
  Watch& watch = *owner;
  if (const std::optional<Duration> timeout = dependency.timeout) {
    watch.timer = loop_.after(*timeout, [&watch, timeout] {
      watch.decide(fmt::format("{} s have passed and it is still not true that {}",
                               std::chrono::duration<double>(*timeout).count(), describe(watch.dependency)));
    });
  }
  if (const auto* const readiness = std::get_if<std::shared_ptr<ReadinessCondition>>(&dependency.condition)) {
    // The condition may live longer than the watch.
    (*readiness)->watch(loop_, [left = std::weak_ptr(owner)](const std::optional<std::string>& failure) {
      if (const WatchPtr same = left.lock()) {
        same->decide(failure);
      }
    });
    return owner;
  }
  by_target_[dependency.target].push_back(&watch);
  lines_watched_ += watch.until_output() != nullptr;
  watch.evaluate();
  return owner;
}

void DependencyWatches::on_process_event(const TrackedProcess& process) {
  if (const auto found = by_target_.find(&process); found != by_target_.end()) {
    for (Watch* const watch : found->second) {
      watch->evaluate();
    }
  }
}

void DependencyWatches::on_line(const TrackedProcess& process, OutputStream stream, std::string_view line) {
  if (const auto found = by_target_.find(&process); found != by_target_.end()) {
    for (Watch* const watch : found->second) {
      watch->on_line(stream, line);
    }
  }
}

}  // namespace launch
