// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracing/model/findings/finders.hpp"
#include "tracing/model/findings/finding.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

// What has the same cause as a finding before it, or is of the same kind.
bool is_told(const Finding& finding, const Findings& told) {
  return std::any_of(told.begin(), told.end(), [&finding](const Finding& before) {
    if (finding.kind == before.kind) {
      return true;
    }
    if (finding.callback &&
        (finding.callback == before.callback ||
         std::find(before.concerned.begin(), before.concerned.end(), *finding.callback) != before.concerned.end())) {
      return true;
    }
    return finding.kind == FindingKind::kBusiestExecutor && before.callback &&
           finding.figures.find(" in " + before.subject) != std::string::npos;
  });
}

}  // namespace

std::int64_t usual_worst(const DurationSummary& times) {
  constexpr std::uint64_t kForP99 = 500;
  constexpr std::uint64_t kForP90 = 50;
  return times.count >= kForP99 ? times.p99_ns : times.count >= kForP90 ? times.p90_ns : times.p50_ns;
}

double at_most(double most, double weight, double value) {
  return std::min(most - 1, weight) + std::min(1.0, std::log10(1 + value) / 20);
}

std::string duration(std::int64_t nanoseconds) {
  return format_duration(static_cast<double>(nanoseconds));
}

std::string mark(bool doubtful, bool estimated) {
  return std::string(estimated ? " (an estimate)" : "") + (doubtful ? " (events were lost)" : "");
}

std::string label(const Hosts& hosts, const CallbackResult& callback) {
  return hosts.before(callback.process) + callback_label(callback);
}

std::string place_in_source(const CallbackResult& callback) {
  return callback_label(callback) + (callback.symbol.empty() ? "" : " (" + callback.brief_symbol() + ")");
}

const CallbackResult* find_callback(const TraceResults& results, std::uint32_t id) {
  const auto& callbacks = results.ros2.callbacks;
  const auto found =
      std::find_if(callbacks.begin(), callbacks.end(), [id](const CallbackResult& one) { return one.id == id; });
  return found == callbacks.end() ? nullptr : &*found;
}

const CallbackResult* callback_of(const TraceResults& results, const SubscriptionResult& subscription) {
  const auto& callbacks = results.ros2.callbacks;
  const auto found = std::find_if(callbacks.begin(), callbacks.end(), [&subscription](const CallbackResult& one) {
    return one.owner == CallbackResult::Owner::kSubscription && one.process == subscription.process &&
           one.node == subscription.node && one.owner_name == subscription.topic;
  });
  return found == callbacks.end() ? nullptr : &*found;
}

Findings find_worth_a_look(const TraceResults& results) {
  Findings findings;
  for (const auto find : {slow_chains, exceeded_budgets, overruns, late_timers, busy_executors, dropped_messages,
                          waiting_messages, long_tails, unanswered_requests, unfinished_callbacks, starved_callbacks,
                          slow_starts, memory_in_active, drifting_timers, dominating_callbacks, blocking_callbacks}) {
    Findings found = find(results);
    std::move(found.begin(), found.end(), std::back_inserter(findings));
  }
  // What several suffer from is told before what one of them suffers, even if that weighs more.
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::pair(!a.concerned.empty(), a.weight) > std::pair(!b.concerned.empty(), b.weight);
  });
  Findings told;
  for (Finding& finding : findings) {
    if (!is_told(finding, told)) {
      told.push_back(std::move(finding));
    }
  }
  std::stable_sort(told.begin(), told.end(), [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  return told;
}

}  // namespace tracing
