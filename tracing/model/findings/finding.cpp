// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

// A callback must take this much longer than usual, and this long, before that is worth a look.
constexpr double kLongTailRatio = 10;
constexpr std::int64_t kLongTail = 1'000'000;
constexpr std::int64_t kLongWait = 1'000'000;
constexpr std::int64_t kSlowStart = 1'000'000'000;
constexpr double kNotableJitter = 0.05;  // of a period
constexpr std::uint64_t kFrequent = 5;   // inputs of a chain
constexpr std::int64_t kSlowChain = 10'000'000;
constexpr double kBusy = 0.5;           // of the time
constexpr double kDominating = 0.3;     // of the time of a thread
constexpr double kNotableDrift = 0.01;  // of a period
constexpr std::int64_t kLeastDrift = 50'000;

std::string duration(std::int64_t nanoseconds) {
  return format_duration(static_cast<double>(nanoseconds));
}

std::string mark(bool doubtful) {
  return doubtful ? " (events were lost)" : "";
}

// "left: /ping, timer 100 ms" if there are several machines
std::string label(const Hosts& hosts, const CallbackResult& callback) {
  return hosts.before(callback.process) + callback_label(callback);
}

// "/scan to left: /planner"
std::string label(const Hosts& hosts, const SubscriptionResult& subscription) {
  return fmt::format("{} to {}{}", subscription.topic, hosts.before(subscription.process),
                     subscription.node.empty() ? "?" : subscription.node);
}

// Keeps the finding with the greatest weight.
void offer(std::optional<Finding>& best, Finding finding) {
  if (!best || finding.weight > best->weight) {
    best = std::move(finding);
  }
}

std::optional<Finding> slowest_chain(const TraceResults& results) {
  // Those with names come first, each of the two lists from the slowest.
  const std::vector<ChainResult>& chains = results.ros2.chains;
  const auto slowest = std::max_element(chains.begin(), chains.end(), [](const ChainResult& a, const ChainResult& b) {
    return std::pair(a.response.count >= kFrequent, a.response.p99_ns) <
           std::pair(b.response.count >= kFrequent, b.response.p99_ns);
  });
  if (slowest == chains.end() || slowest->response.p99_ns < kSlowChain) {
    return std::nullopt;
  }
  const ChainResult& chain = *slowest;
  return Finding{
      Finding::Kind::kSlowestChain, 45, Hosts(results.overview).before(chain) + chain_label(chain),
      fmt::format("{} steps take {}, at p99 {}, at most {}{}", chain.steps.size(), duration(chain.response.p50_ns),
                  duration(chain.response.p99_ns), duration(chain.response.max_ns), mark(chain.doubtful))};
}

std::optional<Finding> over_budget(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const ChainResult& chain : results.ros2.chains) {
    if (!chain.budget_ns || chain.over_budget == 0 || chain.response.count == 0) {
      continue;
    }
    const double share = static_cast<double>(chain.over_budget) / static_cast<double>(chain.response.count);
    const double weight = (chain.response.count >= kFrequent ? 70 : 50) + 25 * share;
    offer(best, {Finding::Kind::kOverBudget, weight, hosts.before(chain) + chain_label(chain),
                 fmt::format("{} of {} took longer than the budget of {}, at most {}{}", chain.over_budget,
                             chain.response.count, duration(*chain.budget_ns), duration(chain.response.max_ns),
                             mark(chain.doubtful))});
  }
  return best;
}

std::optional<Finding> overrun(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.overruns == 0) {
      continue;
    }
    const double share = static_cast<double>(callback.overruns) / static_cast<double>(callback.durations.count);
    offer(best, {Finding::Kind::kOverrun, 60 + 30 * share, label(hosts, callback),
                 fmt::format("{} of {} took longer than the period, at most {}{}", callback.overruns,
                             format_count(callback.durations.count, "run"), duration(callback.durations.max_ns),
                             mark(callback.doubtful)),
                 callback.id});
  }
  return best;
}

std::optional<Finding> worst_jitter(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.owner != CallbackResult::Owner::kTimer || callback.jitter.count < 2 || callback.period_ns <= 0) {
      continue;
    }
    const double ratio = static_cast<double>(callback.jitter.max_ns) / static_cast<double>(callback.period_ns);
    if (ratio < kNotableJitter) {
      continue;
    }
    std::string figures = fmt::format("up to {} off its period, at p99 {}", duration(callback.jitter.max_ns),
                                      duration(callback.jitter.p99_ns));
    if (callback.missed > 0) {
      figures += fmt::format("; {} missed", format_count(callback.missed, "period"));
    }
    const double weight = 20 + 50 * std::min(1.0, ratio) + (callback.missed > 0 ? 20 : 0) + std::min(ratio, 9.0);
    offer(best, {Finding::Kind::kWorstJitter, weight, label(hosts, callback), figures + mark(callback.doubtful),
                 callback.id});
  }
  return best;
}

std::optional<Finding> busiest_executor(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const ExecutorResult& executor : results.ros2.executors) {
    if (executor.callbacks < 2 || executor.utilisation < kBusy ||
        executor.process >= results.overview.processes.size()) {
      continue;
    }
    std::string figures = fmt::format("{:.3g} % busy", executor.utilisation * 100);
    if (executor.longest_busy_ns > 0) {
      figures += fmt::format(", once for {}", duration(executor.longest_busy_ns));
      if (!executor.longest_callback.empty()) {
        figures += " in " + executor.longest_callback;
      }
    }
    offer(best,
          {Finding::Kind::kBusiestExecutor, 90 * std::min(1.0, executor.utilisation),
           hosts.before(executor.process) + executor_label(executor, results), figures + mark(executor.doubtful)});
  }
  return best;
}

std::optional<Finding> dropped_messages(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  std::uint64_t most = 0;
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    const std::uint64_t dropped = subscription.dropped();
    if (dropped <= most) {
      continue;
    }
    most = dropped;
    const std::uint64_t sent = subscription.delivered + dropped;
    std::string places;
    const auto place = [&places](std::uint64_t count, const char* where) {
      if (count > 0) {
        places += fmt::format("{}{} {}", places.empty() ? "" : ", ", count, where);
      }
    };
    place(subscription.overwritten, "pushed out of its queue");
    place(subscription.overwritten_in_buffer, "pushed out of its buffer");
    place(subscription.lost_by_publisher, "lost by the publisher");
    place(subscription.lost_in_transport, "lost in transport");
    place(subscription.lost_unplaced(), "lost on the way");
    place(subscription.not_executed, "not executed");
    best = Finding{Finding::Kind::kDroppedMessages,
                   55 + 40 * std::min(1.0, static_cast<double>(dropped) * 4 / static_cast<double>(sent)),
                   label(hosts, subscription),
                   fmt::format("{} of {}: {}{}", dropped, sent, places, mark(subscription.doubtful)),
                   {},
                   subscription.topic};
  }
  return best;
}

std::optional<Finding> longest_wait(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    if (subscription.executor.count == 0 || subscription.executor.p99_ns < kLongWait) {
      continue;
    }
    const double share = static_cast<double>(subscription.executor.p99_ns) /
                         static_cast<double>(std::max<std::int64_t>(subscription.latency.p99_ns, 1));
    const double milliseconds = static_cast<double>(subscription.executor.p99_ns) / 1e6;
    offer(best, {Finding::Kind::kLongestWait,
                 25 + 25 * std::min(1.0, share) + std::min(20.0, 5 * std::log10(1 + milliseconds)),
                 label(hosts, subscription),
                 fmt::format("messages wait {} for a busy executor, at p99 {} of {} in all{}",
                             duration(subscription.executor.p50_ns), duration(subscription.executor.p99_ns),
                             duration(subscription.latency.p99_ns), mark(subscription.doubtful)),
                 {},
                 subscription.topic});
  }
  return best;
}

std::optional<Finding> long_tail(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.durations.count < 10 || callback.durations.max_ns < kLongTail) {
      continue;
    }
    const double ratio = static_cast<double>(callback.durations.max_ns) /
                         static_cast<double>(std::max<std::int64_t>(callback.durations.p50_ns, 1));
    if (ratio < kLongTailRatio) {
      continue;
    }
    offer(best, {Finding::Kind::kLongTail, std::min(60.0, 20 + 10 * std::log10(ratio)), label(hosts, callback),
                 fmt::format("usually takes {}, at p99 {}, at most {}{}", duration(callback.durations.p50_ns),
                             duration(callback.durations.p99_ns), duration(callback.durations.max_ns),
                             mark(callback.doubtful)),
                 callback.id});
  }
  return best;
}

std::optional<Finding> starved(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.longest_runnable_ns < kLongTail) {
      continue;
    }
    const std::string other =
        callback.ran_instead.empty()
            ? ""
            : fmt::format(", which '{}' had for {}", callback.ran_instead, duration(callback.ran_instead_ns));
    const double milliseconds = static_cast<double>(callback.longest_runnable_ns) / 1e6;
    offer(best, {Finding::Kind::kStarvedCallback, std::min(95.0, 50 + 15 * std::log10(1 + milliseconds)),
                 label(hosts, callback),
                 fmt::format("waited {} for a processor{}; at p99 {}{}", duration(callback.longest_runnable_ns), other,
                             duration(callback.runnable.p99_ns), mark(callback.doubtful)),
                 callback.id});
  }
  return best;
}

std::optional<Finding> slowest_start(const TraceResults& results) {
  std::optional<Finding> best;
  for (const StartResult& start : results.starts) {
    if (!start.ready_after_ns || *start.ready_after_ns < kSlowStart) {
      continue;
    }
    const double seconds = static_cast<double>(*start.ready_after_ns) / 1e9;
    offer(best, {Finding::Kind::kSlowestStart, std::min(40.0, 15 + 5 * seconds),
                 fmt::format("{} [{}]", start.process, start.vpid),
                 fmt::format("ready {} after exec", duration(*start.ready_after_ns))});
  }
  return best;
}

// A node whose callbacks ask for memory while it is active does what real-time systems avoid.
std::optional<Finding> memory_in_active(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const LifecycleResult& state : results.ros2.lifecycle) {
    if (state.state != "active" || state.allocations.value_or(0) == 0) {
      continue;
    }
    const double milliseconds = static_cast<double>(state.end_ns - state.begin_ns) / 1e6;
    offer(best, {Finding::Kind::kMemoryInActive,
                 std::min(50.0, 30 + 5 * std::log10(1 + static_cast<double>(*state.allocations) / milliseconds)),
                 hosts.before(state.process) + (state.node.empty() ? "?" : state.node),
                 fmt::format("its callbacks ask {} for memory while it is active, {} bytes",
                             format_count(*state.allocations, "time"), state.allocated_bytes)});
  }
  return best;
}

std::optional<Finding> unanswered(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallResult& call : results.ros2.calls) {
    const std::uint64_t open = call.unanswered();
    if (open == 0) {
      continue;
    }
    offer(best, {Finding::Kind::kUnanswered, 40 + 40 * static_cast<double>(open) / static_cast<double>(call.requests),
                 call.service,
                 fmt::format("{} of {} from {}{} got no response", open, format_count(call.requests, "request"),
                             hosts.before(call.client_process), call.client.empty() ? "?" : call.client)});
  }
  return best;
}

std::optional<Finding> unfinished(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.unfinished < 2) {
      continue;  // one may be the last one of the trace
    }
    offer(best,
          {Finding::Kind::kUnfinished, 50 + std::min(30.0, static_cast<double>(callback.unfinished)),
           label(hosts, callback),
           fmt::format("{} have no end: an exception, or lost events", format_count(callback.unfinished, "begin")),
           callback.id});
  }
  return best;
}

std::optional<Finding> drifting_timer(const TraceResults& results) {
  const Hosts hosts(results.overview);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    constexpr std::uint64_t kEnough = 10;
    if (callback.owner != CallbackResult::Owner::kTimer || callback.period_ns <= 0 || callback.missed > 0 ||
        callback.overruns > 0 || callback.interval.count < kEnough) {
      continue;
    }
    const std::int64_t drift = std::abs(callback.interval.p50_ns - callback.period_ns);
    const double ratio = static_cast<double>(drift) / static_cast<double>(callback.period_ns);
    if (drift < kLeastDrift || ratio < kNotableDrift) {
      continue;
    }
    offer(best, {Finding::Kind::kDriftingTimer, 35 + 50 * std::min(1.0, ratio), label(hosts, callback),
                 fmt::format("usually called after {}, {:.2g} % off its period{}", duration(callback.interval.p50_ns),
                             100 * ratio, mark(callback.doubtful)),
                 callback.id});
  }
  return best;
}

std::optional<Finding> dominating_callback(const TraceResults& results) {
  const Hosts hosts(results.overview);
  const TraceOverview& overview = results.overview;
  if (!overview.begin_ns || !overview.end_ns || *overview.end_ns <= *overview.begin_ns) {
    return std::nullopt;
  }
  const auto span = static_cast<double>(*overview.end_ns - *overview.begin_ns);
  std::optional<Finding> best;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    const double share = callback.durations.mean_ns * static_cast<double>(callback.durations.count) / span;
    if (share < kDominating || callback.durations.count < 2) {
      continue;
    }
    offer(best,
          {Finding::Kind::kDominatingCallback, 30 + 60 * std::min(1.0, share), label(hosts, callback),
           fmt::format("its {} take {:.2g} % of the time, usually {} each, at most {}{}",
                       format_count(callback.durations.count, "run"), 100 * share, duration(callback.durations.p50_ns),
                       duration(callback.durations.max_ns), mark(callback.doubtful)),
           callback.id});
  }
  return best;
}

// What has the same cause as a finding before it.
bool is_told(const Finding& finding, const std::vector<Finding>& told) {
  return std::any_of(told.begin(), told.end(), [&finding](const Finding& before) {
    if (finding.callback) {
      return finding.callback == before.callback;
    }
    return finding.kind == Finding::Kind::kBusiestExecutor && before.kind == Finding::Kind::kDominatingCallback &&
           finding.figures.find(" in " + before.subject) != std::string::npos;
  });
}

}  // namespace

std::vector<Finding> find_worth_a_look(const TraceResults& results) {
  std::vector<Finding> findings;
  for (const auto find :
       {slowest_chain, over_budget, overrun, worst_jitter, busiest_executor, dropped_messages, longest_wait, long_tail,
        unanswered, unfinished, starved, slowest_start, memory_in_active, drifting_timer, dominating_callback}) {
    if (std::optional<Finding> finding = find(results)) {
      findings.push_back(std::move(*finding));
    }
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  std::vector<Finding> told;
  for (Finding& finding : findings) {
    if (!is_told(finding, told)) {
      told.push_back(std::move(finding));
    }
  }
  return told;
}

}  // namespace tracing
