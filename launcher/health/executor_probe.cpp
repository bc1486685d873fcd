// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/executor_probe.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "launcher/health/progress_memory.hpp"

namespace launch {
namespace {

using executor_progress::Doing;
using executor_progress::Slot;

struct Told {
  Doing doing;
  Duration time;
  bool is_for_ever;
};

Told told_by(const Slot& slot) {
  const std::uint64_t packed = slot.state.load(std::memory_order_acquire);
  const std::uint64_t time = executor_progress::time_of(packed);
  return {executor_progress::doing_of(packed), Duration(static_cast<std::int64_t>(time)),
          time == executor_progress::kNever};
}

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

const char* kind_of_callback(Doing doing) {
  switch (doing) {
    case Doing::kTimer:
      return "a timer callback";
    case Doing::kSubscription:
      return "a subscription callback";
    case Doing::kService:
      return "a service callback";
    case Doing::kClient:
      return "a callback for the response of a service";
    case Doing::kWaitable:
      return "a callback of a waitable (an action, an event, a message within the process)";
    default:
      return nullptr;
  }
}

std::string what_thread_does(char state) {
  switch (state) {
    case 'R':
      return ", its thread computes";
    case 'S':
      return ", its thread sleeps";
    case 'D':
      return ", its thread hangs in the kernel";
    case 'T':
      return ", its thread is stopped";
    default:
      return "";
  }
}

std::string complaint(const Told& told, Duration now, char state) {
  const double time = seconds(now - told.time);
  if (const char* const callback = kind_of_callback(told.doing)) {
    return fmt::format("{} has run for {:.1f} s{}", callback, time, what_thread_does(state));
  }
  if (told.doing == Doing::kWaiting) {
    return fmt::format("an executor has not woken up for a timer that has been due for {:.1f} s", time);
  }
  return fmt::format("an executor has chosen no callback for {:.1f} s{}", time, what_thread_does(state));
}

bool has_ended(std::uint32_t pid) {
  return ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH;
}

}  // namespace

void ExecutorProbe::begin(pid_t) {
  end();
}

void ExecutorProbe::end() {
  clear(page_);
  threads_.fill({});
  without_executor_ = Duration{0};
  wait_.forget();
}

Look ExecutorProbe::look(Duration now, Duration passed) {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (page_.slots[i].pid.load(std::memory_order_acquire) == 0) {
      threads_[i] = {};
    } else {
      follow(page_.slots[i], threads_[i], now, passed);
    }
  }
  return judge_process(now, passed);
}

void ExecutorProbe::follow(const Slot& slot, Thread& thread, Duration now, Duration passed) {
  const std::uint32_t tid = slot.tid.load(std::memory_order_relaxed);
  const std::uint64_t steps = slot.steps.load(std::memory_order_acquire);
  const Told told = told_by(slot);
  if (told.doing == Doing::kNothing || told.is_for_ever || now <= told.time) {
    thread = {tid, steps};
    return;
  }
  const auto pid = static_cast<pid_t>(slot.pid.load(std::memory_order_relaxed));
  const Duration waited = wait_.of_thread(pid, static_cast<pid_t>(tid), passed);
  if (thread.tid != tid || thread.steps != steps || thread.age == Duration{0}) {
    thread = {tid, steps, std::min(now - told.time, passed)};
  } else {
    thread.age += passed - waited;
    thread.starved += waited;
  }
}

Look ExecutorProbe::judge_process(Duration now, Duration passed) {
  bool has_slot = false;
  bool spins = false;
  bool is_debugged = false;
  std::string note;
  const Thread* away = nullptr;
  Duration away_since{0};
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    Slot& slot = page_.slots[i];
    const std::uint32_t pid = slot.pid.load(std::memory_order_acquire);
    if (pid == 0) {
      continue;
    }
    has_slot = true;
    const Thread& thread = threads_[i];
    const Told told = told_by(slot);
    if (told.doing == Doing::kAway) {
      if (away == nullptr || thread.age < away->age) {
        away = &thread;
        away_since = told.time;
      }
      continue;
    }
    spins |= told.doing != Doing::kNothing;
    if (thread.age < timeout_) {
      if (thread.starved > timeout_ / 2) {
        note = "it waits for a processor most of the time, which does not count for its health";
      }
      continue;
    }
    if (has_ended(pid)) {
      slot.pid.store(0, std::memory_order_relaxed);
      continue;
    }
    const char state = state_of_thread(static_cast<pid_t>(pid), static_cast<pid_t>(thread.tid));
    if (state == 't') {
      is_debugged = true;
      continue;
    }
    return {Look::Result::kBad, complaint(told, now, state), note};
  }
  if (is_debugged) {
    return {.note = "a debugger holds it: its executors are not judged"};
  }
  if (!spins && away != nullptr) {
    return away->age < timeout_
               ? Look{Look::Result::kGood, {}, note}
               : Look{Look::Result::kBad, fmt::format("no executor has spun for {:.1f} s", seconds(now - away_since))};
  }
  if (has_slot) {
    return {spins ? Look::Result::kGood : Look::Result::kPending, {}, note};
  }
  without_executor_ += passed;
  if (without_executor_ < timeout_) {
    return {};
  }
  if (page_.joined.load(std::memory_order_relaxed) == 0) {
    return {.note =
                "it tells nothing of its executors, so they can't be watched: only programs with rclcpp of this "
                "project do (docs/supervision.md)"};
  }
  return {Look::Result::kBad, fmt::format("no executor has begun to spin for {:.1f} s", seconds(without_executor_))};
}

}  // namespace launch
