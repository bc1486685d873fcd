// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start_order.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launch {

namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

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
                    },
                    condition.state);
}

}  // namespace

void StartOrder::add(ProcessSpec spec, TrackedProcess& process, std::vector<Dependency> dependencies) {
  const auto waiting = std::make_shared<Waiting>(std::move(spec), process);
  waiting->place = waiting_.insert(waiting_.end(), waiting);
  waiting->open = dependencies.size();
  for (Dependency& dependency : dependencies) {
    callbacks_.tell(LogLevel::kInfo, waiting->spec.name, fmt::format("waits until {}", describe(dependency)));
    waiting->watches.push_back({std::move(dependency), waiting.get()});
    begin(waiting->watches.back());
  }
}

std::unordered_map<const TrackedProcess*, const ProcessSpec*> StartOrder::waiting() const {
  std::unordered_map<const TrackedProcess*, const ProcessSpec*> processes;
  for (const WaitingPtr& waiting : waiting_) {
    processes.emplace(waiting->process, &waiting->spec);
  }
  return processes;
}

void StartOrder::begin(Watch& watch) {
  if (const std::optional<Duration> timeout = watch.dependency.timeout) {
    watch.timer = loop_.after(*timeout, [this, &watch, timeout] {
      fail(watch, fmt::format("{} s have passed and it is still not true that {}",
                              std::chrono::duration<double>(*timeout).count(), describe(watch.dependency)));
    });
  }
  if (auto* const readiness = std::get_if<std::shared_ptr<ReadinessCondition>>(&watch.dependency.condition)) {
    (*readiness)->watch(loop_, [this, &watch](const std::optional<std::string>& failure) {
      failure ? fail(watch, *failure) : settle(watch);
    });
    return;
  }
  by_target_[watch.dependency.target].push_back(&watch);
  lines_watched_ += std::holds_alternative<UntilOutput>(std::get<ProcessCondition>(watch.dependency.condition).state);
  evaluate(watch);
}

void StartOrder::evaluate(Watch& watch) {
  const Verdict verdict = judge(std::get<ProcessCondition>(watch.dependency.condition), *watch.dependency.target);
  if (verdict.holds) {
    settle(watch);
  } else if (verdict.failure) {
    fail(watch, *verdict.failure);
  }
}

void StartOrder::on_process_event(TrackedProcess& process) {
  if (const auto found = by_target_.find(&process); found != by_target_.end()) {
    for (Watch* const watch : found->second) {
      evaluate(*watch);
    }
  }
}

void StartOrder::on_line(TrackedProcess& process, OutputStream stream, std::string_view line) {
  const auto found = by_target_.find(&process);
  if (found == by_target_.end()) {
    return;
  }
  for (Watch* const watch : found->second) {
    const auto* const until = std::get_if<UntilOutput>(&std::get<ProcessCondition>(watch->dependency.condition).state);
    if (until != nullptr && !watch->settled && until->pattern.matches(stream, line)) {
      settle(*watch);
    }
  }
}

void StartOrder::settle(Watch& watch) {
  if (!watch.settled && !watch.failure) {
    watch.settled = true;
    watch.timer.reset();
    --watch.owner->open;
    callbacks_.holds(watch.owner->spec.name, watch.dependency);
    proceed_later(*watch.owner);
  }
}

void StartOrder::fail(Watch& watch, std::string why) {
  if (!watch.settled && !watch.failure) {
    watch.failure = std::move(why);
    proceed_later(*watch.owner);
  }
}

void StartOrder::proceed_later(Waiting& waiting) {
  if (changed_.empty()) {
    loop_.post([this] { proceed(); });
  }
  changed_.push_back(waiting.shared_from_this());
}

void StartOrder::proceed() {
  for (const WaitingPtr& waiting : std::exchange(changed_, {})) {
    if (!waiting->ended) {
      deal_with_failures(waiting);
    }
    if (!waiting->ended && waiting->open == 0) {
      end(*waiting);
      callbacks_.start(std::move(waiting->spec), *waiting->process);
    }
  }
}

void StartOrder::deal_with_failures(const WaitingPtr& waiting) {
  for (Watch& watch : waiting->watches) {
    if (!watch.failure || watch.settled) {
      continue;
    }
    watch.settled = true;
    watch.timer.reset();
    --waiting->open;
    const std::string& name = waiting->spec.name;
    const std::string place = to_string(watch.dependency.where);
    switch (watch.dependency.on_failure) {
      case OnFailure::kStart:
        callbacks_.tell(LogLevel::kWarning, name, fmt::format("starts although {} ({})", *watch.failure, place));
        continue;
      case OnFailure::kSkip:
        callbacks_.tell(LogLevel::kError, name, fmt::format("is not started: {} ({})", *watch.failure, place));
        waiting->process->is_over = true;
        end(*waiting);
        on_process_event(*waiting->process);  // other processes may wait for this one
        callbacks_.skipped(*waiting->process);
        return;
      case OnFailure::kShutdown: {
        const LaunchError error(fmt::format("'{}' can't start: {}", name, *watch.failure), watch.dependency.where,
                                "on_failure=\"start\" starts it all the same, on_failure=\"skip\" goes on without it");
        end(*waiting);
        callbacks_.fail(error);
        return;
      }
    }
  }
}

bool StartOrder::drop(const TrackedProcess& process) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const WaitingPtr& candidate) { return candidate->process == &process; });
  if (found == waiting_.end()) {
    return false;
  }
  const WaitingPtr waiting = *found;
  end(*waiting);
  waiting->process->is_over = true;
  on_process_event(*waiting->process);
  callbacks_.skipped(*waiting->process);
  return true;
}

void StartOrder::clear() {
  for (const WaitingPtr& waiting : waiting_) {
    waiting->ended = true;
    waiting->watches.clear();
  }
  waiting_.clear();
  by_target_.clear();
  lines_watched_ = 0;
}

void StartOrder::end(Waiting& waiting) {
  waiting.ended = true;
  for (const Watch& watch : waiting.watches) {
    if (const auto* const condition = std::get_if<ProcessCondition>(&watch.dependency.condition)) {
      lines_watched_ -= std::holds_alternative<UntilOutput>(condition->state);
      const auto found = by_target_.find(watch.dependency.target);
      std::erase(found->second, &watch);
      if (found->second.empty()) {
        by_target_.erase(found);
      }
    }
  }
  waiting_.erase(waiting.place);
}

}  // namespace launch
