// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/user/status_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/text/names.hpp"

namespace launch {

StatusLine::StatusLine(EventLoop& loop, ProcessSupervisor& supervisor, const Steering& steering,
                       std::function<void(const std::string& line)> show)
    : loop_(loop), supervisor_(supervisor), steering_(steering), show_(std::move(show)) {
  supervisor_.observe([this](const ProcessEvent& event) { on_event(event); });
  begin(Phase::kStarting);
}

void StatusLine::suspend(bool suspended) {
  suspended_ = suspended;
  refresh();
}

void StatusLine::on_event(const ProcessEvent&) {
  if (phase_ != Phase::kStopping && steering_.is_ending()) {
    begin(Phase::kStopping);
    to_end_ = supervisor_.alive().size();
  } else if (phase_ == Phase::kRunning) {
    begin(Phase::kStarting);
  } else if (loop_.now() >= shown_ + kRate) {
    // Many processes start in one turn of the loop, in which no timer calls.
    refresh();
  } else if (!timer_) {
    timer_ = loop_.after(kRate, [this] { refresh(); });
  }
}

void StatusLine::begin(Phase phase) {
  phase_ = phase;
  show_("");
  shown_ = loop_.now() + kPatience - kRate;
  timer_ = loop_.after(kPatience, [this] { refresh(); });
}

void StatusLine::refresh() {
  timer_.reset();
  shown_ = loop_.now();
  const std::string line = phase_ == Phase::kStopping ? stopping() : starting();
  if (line.empty() && phase_ == Phase::kStarting) {
    phase_ = Phase::kRunning;
  }
  show_(suspended_ ? std::string() : line);
  if (!line.empty() && phase_ == Phase::kStopping) {
    timer_ = loop_.after(kCountdown, [this] { refresh(); });
  }
}

std::string StatusLine::starting() const {
  const std::vector<SteeredProcess> all = steering_.processes();
  std::size_t left = 0;
  std::vector<std::string> waiting;
  for (const SteeredProcess& process : all) {
    left += process.id == 0 && !process.tracked->is_over ? 1 : 0;
    if (process.waits) {
      waiting.push_back(process.name);
    }
  }
  if (left == 0) {
    return "";
  }
  const std::string names = waiting.empty() ? "" : fmt::format(", waiting: {}", list_some(waiting));
  return fmt::format("starting {} of {}{}", all.size() - left, all.size(), names);
}

std::string StatusLine::stopping() const {
  const std::vector<std::string> left = supervisor_.alive();
  if (left.empty()) {
    return "";
  }
  Duration next = Duration::max();
  const char* signal = "";
  for (ProcessId id = 1; id < supervisor_.next_id(); ++id) {
    const ProcessView view = supervisor_.view(id);
    const bool escalates = view.state == ProcessState::kInterrupting || view.state == ProcessState::kTerminating;
    if (escalates && view.next_step_in < next) {
      next = view.next_step_in;
      signal = view.state == ProcessState::kInterrupting ? "SIGTERM" : "SIGKILL";
    }
  }
  const std::string step =
      *signal == '\0' ? ""
                      : fmt::format(", {} in {} s", signal,
                                    std::max<std::int64_t>(std::chrono::ceil<std::chrono::seconds>(next).count(), 0));
  return fmt::format("stopping: {} of {} still run{}: {}", left.size(), std::max(to_end_, left.size()), step,
                     list_some(left));
}

}  // namespace launch
