// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/overhead_guard.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <set>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

using Clock = std::chrono::steady_clock;

// Long enough that a burst is no reason, short enough that little is recorded beyond the budget.
constexpr std::chrono::milliseconds kWindow{500};

using Counts = std::map<std::string, std::uint64_t>;  // by event

// Of all processes. Those of initialisation come once; nothing would be gained by a cut.
Counts runtime_events(const std::vector<EventCounts>& processes) {
  static const std::set<std::string> initialisation(initialisation_ros_events().begin(),
                                                    initialisation_ros_events().end());
  Counts sums;
  for (const EventCounts& process : processes) {
    for (const auto& [event, count] : process.events) {
      if (!initialisation.contains(event)) {
        sums[event] += count;
      }
    }
  }
  return sums;
}

Counts difference(Counts after, const Counts& before) {
  for (const auto& [event, count] : before) {
    after[event] -= count;
  }
  return after;
}

std::uint64_t total(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& entry) { return sum + entry.second; });
}

// How many events of the class came, of those that are counted.
std::uint64_t events_of(const DroppableClass& drop, const Counts& came) {
  std::uint64_t sum = 0;
  for (const DroppableRule& rule : drop.rules) {
    const auto found = came.find(rule.event);
    sum += found != came.end() ? found->second : 0;
  }
  return sum;
}

// False for a class whose events are counted, and did not come: nothing would be gained.
bool is_worth_a_cut(const DroppableClass& drop, const Counts& came) {
  return std::any_of(drop.rules.begin(), drop.rules.end(), [&came](const DroppableRule& rule) {
    if (!rule.event.starts_with("ros2:")) {
      return true;
    }
    const auto found = came.find(rule.event);
    return found != came.end() && found->second != 0;
  });
}

}  // namespace

bool is_over_budget(const TraceConfig& config, double ns_per_event, std::uint64_t rate) {
  return static_cast<double>(rate) * ns_per_event / 1e9 > config.max_overhead;
}

OverheadGuard::OverheadGuard(const TraceConfig& config, double ns_per_event, std::function<void(const EventCut&)> told)
    : config_(config), ns_per_event_(ns_per_event), told_(std::move(told)) {
  std::vector<std::string> warnings;
  left_ = plan_drops(config.drop_order, plan_channels(config, warnings));
  if (left_.empty()) {
    throw TraceError("max-overhead has no events that it may drop",
                     "record run-time events of ros2, or name others in drop-order");
  }
  thread_ = std::thread([this] { watch(); });
}

OverheadGuard::~OverheadGuard() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_one();
  thread_.join();
}

void OverheadGuard::watch() {
  EventCounters counters(config_.event_counters);
  Counts before = runtime_events(counters.read());
  Clock::time_point began = Clock::now();
  bool told_of_excess = false;
  std::unique_lock lock(mutex_);
  while (!stopped_.wait_for(lock, kWindow, [this] { return stop_; })) {
    lock.unlock();
    const Counts came = difference(runtime_events(counters.read()), before);
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    const auto rate = static_cast<std::uint64_t>(static_cast<double>(total(came)) / seconds);
    // As many classes at once as the estimate asks for: each further window would be recorded beyond the budget.
    std::uint64_t remaining = rate;
    bool is_known = true;
    while (is_known && is_over_budget(config_, ns_per_event_, remaining)) {
      const auto next = std::find_if(left_.begin(), left_.end(),
                                     [&came](const DroppableClass& drop) { return is_worth_a_cut(drop, came); });
      if (next == left_.end()) {
        if (!told_of_excess) {
          told_of_excess = true;
          told_({.rate = remaining, .share = static_cast<double>(remaining) * ns_per_event_ / 1e9});
        }
        break;
      }
      const DroppableClass drop = *next;
      left_.erase(next);
      cut(drop, remaining);
      const std::uint64_t saved = static_cast<std::uint64_t>(static_cast<double>(events_of(drop, came)) / seconds);
      is_known = saved != 0;  // or its events are not counted, and the next window tells
      remaining -= std::min(remaining, saved);
    }
    // The count starts anew, because events that fired while LTTng was switching events off tell nothing about the new
    // rate.
    before = runtime_events(counters.read());
    began = Clock::now();
    lock.lock();
  }
}

void OverheadGuard::cut(const DroppableClass& drop, std::uint64_t rate) {
  EventCut made{.event_class = drop.name,
                .events = {},
                .time = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count(),
                .rate = rate,
                .share = static_cast<double>(rate) * ns_per_event_ / 1e9};
  for (const DroppableRule& rule : drop.rules) {
    const DomainHandle handle = domain_handle(config_.lttng_session_name(), LTTNG_DOMAIN_UST);
    if (lttng_disable_event(handle.get(), rule.event.c_str(), rule.channel.c_str()) >= 0) {
      made.events.push_back(rule.event);
    }
  }
  if (made.events.empty()) {
    return;  // the session was ended, or the events were switched off, by somebody else
  }
  note_cut(config_, made);
  told_(made);
}

}  // namespace tracing
