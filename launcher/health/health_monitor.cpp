// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/health_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

namespace launch {
namespace {

// It is said only once in a while, because a busy machine may be late again and again.
constexpr std::chrono::minutes kBetweenWords{1};
// Others may wait until a process is healthy, so the first look is early.
constexpr std::chrono::seconds kLatestFirst{1};

}  // namespace

void HealthMonitor::expect(const ProcessSpec& spec) {
  watches_output_ |= std::any_of(spec.watches.begin(), spec.watches.end(), [](const HealthWatch& watch) {
    return std::holds_alternative<OutputLines>(watch.subject);
  });
}

void HealthMonitor::prepare(ProcessSpec& spec, ProcessId id) {
  processes_.erase(id);  // it may have had other watches
  if (spec.watches.empty() || is_over_) {
    return;
  }
  Watched& process = processes_[id];
  for (const HealthWatch& given : spec.watches) {
    try {
      std::unique_ptr<HealthProbe> probe = make_probe(given, spec, id, process.watches.size());
      process.watches.emplace_back(Watch{.spec = given, .probe = std::move(probe)});
    } catch (const std::system_error& error) {
      callbacks_.tell(LogLevel::kWarning, spec.name,
                      fmt::format("it can't be watched: {} ({})", error.what(), to_string(given.where)));
    }
  }
}

void HealthMonitor::on_event(const ProcessEvent& event) {
  if (is_over_) {
    return;
  }
  const auto found = processes_.find(event.id);
  if (found == processes_.end()) {
    return;
  }
  if (const auto* const started = std::get_if<ProcessStarted>(&event.what)) {
    found->second.label = event.label;
    begin(found->second, started->pid);
  } else if (std::holds_alternative<ProcessExited>(event.what)) {
    end(found->second);
  }
}

void HealthMonitor::on_line(ProcessId id, OutputStream stream, std::string_view line) {
  if (const auto found = processes_.find(id); found != processes_.end()) {
    for (const Watch& watch : found->second.watches) {
      watch.probe->on_line(stream, line);
    }
  }
}

void HealthMonitor::shutdown() {
  is_over_ = true;
  timer_.reset();
  for (auto& [id, process] : processes_) {
    end(process);
  }
}

void HealthMonitor::begin(Watched& process, pid_t pid) {
  process.runs = true;
  process.health = Health::kStarting;
  const Duration now = loop_.now();
  for (Watch& watch : process.watches) {
    watch.state = Look::Result::kPending;
    watch.reason.clear();
    watch.noted.clear();
    watch.failures = 0;
    watch.ran_for = Duration{0};
    watch.last = now;
    // On a grid, so that watches of the same interval are due at the same time.
    const Duration step = std::min<Duration>(watch.spec.interval, kLatestFirst);
    watch.next = (now / step + 1) * step;
    watch.probe->begin(pid);
    wait_until(watch.next);
  }
}

void HealthMonitor::end(Watched& process) {
  process.runs = false;
  process.health = Health::kUnwatched;
  for (const Watch& watch : process.watches) {
    watch.probe->end();
  }
}

void HealthMonitor::wait_until(Duration time) {
  if (!is_over_ && (!timer_ || time < due_)) {
    due_ = time;
    timer_ = loop_.after(std::max(time - loop_.now(), Duration{0}), [this] { look(); });
  }
}

void HealthMonitor::look() {
  const Duration now = loop_.now();
  const Duration late = now - due_;
  const bool counts = late <= kLatest;
  if (!counts && (!said_late_ || now - *said_late_ > kBetweenWords)) {
    said_late_ = now;
    callbacks_.tell(LogLevel::kInfo, "launch",
                    fmt::format("the health of processes was not looked at for {:.1f} s: the machine was suspended, or "
                                "the launch was stopped or got no processor; this time does not count",
                                std::chrono::duration<double>(late).count()));
  }
  timer_.reset();
  // What follows from a look may end the launch, but adds no process: those start in a later turn.
  for (auto& [id, process] : processes_) {
    if (!may_judge(id, process)) {
      continue;
    }
    bool has_looked = false;
    for (Watch& watch : process.watches) {
      if (watch.next <= now) {
        look_at(process, watch, now, counts);
        has_looked = true;
      }
    }
    if (has_looked) {
      conclude(id, process);
    }
  }
  for (auto& [id, process] : processes_) {
    for (Watch& watch : process.watches) {
      if (process.runs && watch.next <= now) {
        watch.next = (now / watch.spec.interval + 1) * watch.spec.interval;
      }
      if (process.runs) {
        wait_until(watch.next);
      }
    }
  }
}

void HealthMonitor::look_at(Watched& process, Watch& watch, Duration now, bool counts) {
  const Duration passed = counts ? std::min(now - watch.last, watch.spec.interval) : Duration{0};
  watch.last = now;
  watch.ran_for += passed;
  judge(process, watch, watch.probe->look(now, passed));
}

void HealthMonitor::answer(ProcessId id, std::size_t number, const Look& look) {
  Watched& process = processes_.at(id);
  if (may_judge(id, process)) {
    judge(process, process.watches.at(number), look);
    conclude(id, process);
  }
}

// A process that was asked to end may stand still.
bool HealthMonitor::may_judge(ProcessId id, const Watched& process) const {
  return process.runs && !is_over_ && supervisor_.state(id) == ProcessState::kRunning;
}

void HealthMonitor::judge(Watched& process, Watch& watch, const Look& look) {
  if (!look.note.empty() && watch.noted.empty()) {
    watch.noted = look.note;
    callbacks_.tell(LogLevel::kWarning, process.label, fmt::format("{} ({})", look.note, to_string(watch.spec.where)));
  }
  const bool is_starting = watch.state == Look::Result::kPending && watch.ran_for < watch.spec.start_period;
  if (look.result == Look::Result::kGood) {
    watch.failures = 0;
    watch.state = Look::Result::kGood;
    watch.reason.clear();
  } else if (look.result == Look::Result::kBad && !is_starting && ++watch.failures >= watch.spec.failures) {
    watch.state = Look::Result::kBad;
    watch.reason = look.why;
  }
}

void HealthMonitor::conclude(ProcessId id, Watched& process) {
  const auto in_state = [](Look::Result state) { return [state](const Watch& watch) { return watch.state == state; }; };
  const auto bad = std::find_if(process.watches.begin(), process.watches.end(), in_state(Look::Result::kBad));
  const bool is_good = std::all_of(process.watches.begin(), process.watches.end(), in_state(Look::Result::kGood));
  const Health health = bad != process.watches.end() ? Health::kUnhealthy : is_good ? Health::kHealthy : process.health;
  // Of several watches, one that is pending again leaves the process as it was.
  if (health == process.health) {
    return;
  }
  const Health before = std::exchange(process.health, health);
  if (health != Health::kUnhealthy) {
    supervisor_.set_health(id, {health, before, {}, {}});
    return;
  }
  supervisor_.set_health(id, {health, before, bad->reason, bad->spec.where});
  callbacks_.unhealthy(id, bad->spec, bad->reason);
}

}  // namespace launch
