// SPDX-License-Identifier: Apache-2.0
// Decides whether and when a process that has ended starts again.
#include <algorithm>
#include <chrono>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

// Tells what will be: with its limit reached, and no time after which it may start again, it stays down.
bool Supervision::respawns(const Supervised& process) const {
  return wants_respawn(process) && !(limit_reached(process) && !process.spec.start_limit.cool_down);
}

bool Supervision::limit_reached(const Supervised& process) const {
  const StartLimit& limit = process.spec.start_limit;
  const Duration first = loop.now() - limit.within;
  return limit.starts > 0 && std::count_if(process.starts.begin(), process.starts.end(),
                                           [&](Duration start) { return start >= first; }) >= limit.starts;
}

bool Supervision::wants_respawn(const Supervised& process) const {
  if (shutting_down || process.request != Request::kNone) {
    return !shutting_down && process.request != Request::kStop;
  }
  const RespawnPolicy& policy = process.spec.respawn;
  return policy.enabled && (policy.max_retries < 0 || process.retries < policy.max_retries);
}

// The run is over: decides what comes next.
void Supervision::conclude(Supervised& process) {
  if (!process.unreaped) {
    process.process = Process{};
  }
  if (!wants_respawn(process)) {
    finish(process);
  } else if (process.request == Request::kRestart) {
    process.retries = -1;  // this start is no retry
    process.respawn_delay.reset();
    wait_for_respawn(process, Duration{0});
  } else {
    process.retries -= process.request == Request::kRestartUnhealthy ? 1 : 0;  // no retry, either
    start_later(process, process.respawn_delay.next(process.spec.respawn, process.ran_for));
    if (process.state == ProcessState::kRespawnDelay && process.respawn_delay.slows_down()) {
      notify(process, RespawnSlowed{RespawnDelay::kShortRuns});
    }
  }
}

// After the delay, or as the limit of starts says.
void Supervision::start_later(Supervised& process, Duration delay) {
  const StartLimit& limit = process.spec.start_limit;
  if (!limit_reached(process)) {
    while (!process.starts.empty() && process.starts.front() < loop.now() - limit.within) {
      process.starts.pop_front();
    }
    wait_for_respawn(process, delay);
    return;
  }
  process.starts.clear();
  notify(process, StartLimitReached{limit.starts, limit.within, limit.cool_down});
  if (limit.cool_down) {
    process.respawn_delay.reset();
    wait_for_respawn(process, *limit.cool_down);
  } else {
    finish(process);
  }
}

void Supervision::wait_for_respawn(Supervised& process, Duration delay) {
  process.state = ProcessState::kRespawnDelay;
  ++process.retries;
  start_timer(process, delay);
}

Duration RespawnDelay::next(const RespawnPolicy& policy, Duration ran_for) {
  if (policy.backoff <= 1.0) {
    return policy.delay > Duration{0} ? policy.delay : delay_of_short_runs(ran_for);
  }
  if (next_ == Duration{0} || ran_for > policy.max_delay) {
    next_ = policy.delay;
  }
  const Duration delay = std::min(next_, policy.max_delay);
  // Compared as seconds: the product may be too large for a Duration.
  using Seconds = std::chrono::duration<double>;
  const Seconds longer = Seconds(delay) * policy.backoff;
  next_ = longer < Seconds(policy.max_delay) ? std::chrono::duration_cast<Duration>(longer) : policy.max_delay;
  return delay;
}

Duration RespawnDelay::delay_of_short_runs(Duration ran_for) {
  constexpr Duration kShort = std::chrono::seconds(1);
  constexpr Duration kFirst = std::chrono::milliseconds(100);
  constexpr Duration kLongest = std::chrono::seconds(5);
  short_runs_ = ran_for < kShort ? short_runs_ + 1 : 0;
  if (short_runs_ < kShortRuns) {
    return Duration{0};
  }
  next_ = short_runs_ == kShortRuns ? kFirst : std::min(next_ * 2, kLongest);
  return next_;
}

}  // namespace launch
