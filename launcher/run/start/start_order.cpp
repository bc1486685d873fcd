// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/start_order.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launch {

void StartOrder::add(ProcessSpec spec, TrackedProcess& process, std::vector<Dependency> dependencies) {
  const auto waiting = std::make_shared<Waiting>(std::move(spec), process);
  waiting->place = waiting_.insert(waiting_.end(), waiting);
  waiting->open = dependencies.size();
  for (Dependency& dependency : dependencies) {
    callbacks_.tell(LogLevel::kInfo, waiting->spec.name, fmt::format("waits until {}", describe(dependency)));
    waiting->watches.push_back({std::move(dependency), waiting.get()});
    Watch& watch = waiting->watches.back();
    watch.watch = watches_.begin(watch.dependency,
                                 [this, &watch](const std::optional<std::string>& failure) { decide(watch, failure); });
  }
}

std::unordered_map<const TrackedProcess*, const ProcessSpec*> StartOrder::waiting() const {
  std::unordered_map<const TrackedProcess*, const ProcessSpec*> processes;
  for (const WaitingPtr& waiting : waiting_) {
    processes.emplace(waiting->process, &waiting->spec);
  }
  return processes;
}

void StartOrder::on_process_event(TrackedProcess& process) {
  watches_.on_process_event(process);
}

void StartOrder::on_line(TrackedProcess& process, OutputStream stream, std::string_view line) {
  watches_.on_line(process, stream, line);
}

void StartOrder::decide(Watch& watch, const std::optional<std::string>& failure) {
  if (failure) {
    watch.failure = failure;
  } else {
    watch.settled = true;
    --watch.owner->open;
    callbacks_.holds(watch.owner->spec.name, watch.dependency);
  }
  proceed_later(*watch.owner);
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

void StartOrder::withdraw(const TrackedProcess& process) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const WaitingPtr& candidate) { return candidate->process == &process; });
  if (found != waiting_.end()) {
    const WaitingPtr waiting = *found;
    end(*waiting);
  }
}

std::vector<const TrackedProcess*> StartOrder::targets(const TrackedProcess& process) const {
  std::vector<const TrackedProcess*> targets;
  for (const WaitingPtr& waiting : waiting_) {
    for (const Watch& watch : waiting->watches) {
      if (waiting->process == &process && watch.dependency.target != nullptr) {
        targets.push_back(watch.dependency.target);
      }
    }
  }
  return targets;
}

void StartOrder::clear() {
  for (const WaitingPtr& waiting : waiting_) {
    waiting->ended = true;
    waiting->watches.clear();
  }
  waiting_.clear();
}

void StartOrder::end(Waiting& waiting) {
  waiting.ended = true;
  for (Watch& watch : waiting.watches) {
    watch.watch.reset();
  }
  waiting_.erase(waiting.place);
}

}  // namespace launch
