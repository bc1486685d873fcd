// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracing/model/findings/finders.hpp"
#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

constexpr std::int64_t kSlowStart = 3'000'000'000;
constexpr std::uint64_t kFrequent = 5;  // inputs of a chain
constexpr std::int64_t kSlowChain = 10'000'000;
constexpr double kBusy = 0.5;  // of the time

// "launch report DIR --chain /camera /brake shows where the time goes"
std::string step_by_step(const ChainResult& chain) {
  if (chain.steps.empty() || chain.steps.front().node.empty() || chain.steps.back().node.empty()) {
    return "launch report DIR --all shows where the time goes";
  }
  return fmt::format("launch report DIR --chain {} {} shows where the time goes", chain.steps.front().node,
                     chain.steps.back().node);
}

// What the chain usually takes without the time in which it waits for a timer, as it does where a node keeps messages:
// its callbacks, and their waits for an executor.
std::int64_t usual_work(const TraceResults& results, const ChainResult& chain) {
  std::int64_t work_ns = 0;
  for (const ChainResult::Step& step : chain.steps) {
    const CallbackResult* const callback = find_callback(results, step.callback_id);
    work_ns += callback == nullptr ? 0 : callback->durations.p50_ns;
    work_ns += step.executor.count == 0 ? 0 : step.executor.p50_ns;
  }
  return work_ns;
}

}  // namespace

Findings slow_chains(const TraceResults& results) {
  Findings findings;
  for (const ChainResult& chain : results.ros2.chains) {
    if (chain.budget_ns || chain.response.count < kFrequent || chain.response.p50_ns < kSlowChain ||
        usual_work(results, chain) < kSlowChain) {
      continue;
    }
    // Of two, the one that usually takes longer.
    const double weight = 40 + std::min(10.0, std::log10(static_cast<double>(chain.response.p50_ns) / kSlowChain));
    findings.push_back({Finding::Kind::kSlowestChain, weight,
                        Hosts(results.overview).before(chain) + chain_label(chain),
                        fmt::format("{} steps take {}, at p99 {}, at most {}{}", chain.steps.size(),
                                    duration(chain.response.p50_ns), duration(chain.response.p99_ns),
                                    duration(chain.response.max_ns), mark(chain.doubtful, chain.estimated)),
                        step_by_step(chain)});
  }
  return findings;
}

Findings exceeded_budgets(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const ChainResult& chain : results.ros2.chains) {
    if (!chain.budget_ns || chain.over_budget == 0 || chain.response.count == 0) {
      continue;
    }
    const double share = static_cast<double>(chain.over_budget) / static_cast<double>(chain.response.count);
    const double weight = (chain.response.count >= kFrequent ? 70 : 50) + 25 * share;
    findings.push_back({Finding::Kind::kOverBudget, weight, hosts.before(chain) + chain_label(chain),
                        fmt::format("{} of {} took longer than the budget of {}, at most {}{}", chain.over_budget,
                                    chain.response.count, duration(*chain.budget_ns), duration(chain.response.max_ns),
                                    mark(chain.doubtful, chain.estimated)),
                        step_by_step(chain)});
  }
  return findings;
}

Findings busy_executors(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
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
    findings.push_back({Finding::Kind::kBusiestExecutor, 90 * std::min(1.0, executor.utilisation),
                        hosts.before(executor.process) + executor_label(executor, results),
                        figures + mark(executor.doubtful),
                        "give some of its nodes an executor of their own, or it several threads"});
  }
  return findings;
}

Findings slow_starts(const TraceResults& results) {
  Findings findings;
  for (const StartResult& start : results.starts) {
    if (!start.ready_after_ns || *start.ready_after_ns < kSlowStart) {
      continue;
    }
    const double seconds = static_cast<double>(*start.ready_after_ns) / 1e9;
    findings.push_back({Finding::Kind::kSlowestStart, at_most(40, 15 + 5 * seconds, seconds),
                        fmt::format("{} [{}]", start.process, start.vpid),
                        fmt::format("ready {} after exec", duration(*start.ready_after_ns)),
                        "launch report DIR --all shows the phases of each start"});
  }
  return findings;
}

// A node whose callbacks ask for memory while it is active does what real-time systems avoid.
Findings memory_in_active(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const LifecycleResult& state : results.ros2.lifecycle) {
    if (state.state != "active" || state.allocations.value_or(0) == 0) {
      continue;
    }
    const double milliseconds = static_cast<double>(state.end_ns - state.begin_ns) / 1e6;
    const CallbackResult* most = nullptr;
    for (const CallbackResult& callback : results.ros2.callbacks) {
      if (callback.process == state.process && callback.node == state.node && callback.allocations.value_or(0) > 0 &&
          (most == nullptr || callback.allocations > most->allocations)) {
        most = &callback;
      }
    }
    findings.push_back({Finding::Kind::kMemoryInActive,
                        std::min(50.0, 30 + 5 * std::log10(1 + static_cast<double>(*state.allocations) / milliseconds)),
                        hosts.before(state.process) + (state.node.empty() ? "?" : state.node),
                        fmt::format("its callbacks ask {} for memory while it is active, {} bytes",
                                    format_count(*state.allocations, "time"), state.allocated_bytes),
                        most == nullptr
                            ? "ask for memory in on_configure()"
                            : fmt::format("most by {}: ask for it in on_configure()", place_in_source(*most))});
  }
  return findings;
}

}  // namespace tracing
