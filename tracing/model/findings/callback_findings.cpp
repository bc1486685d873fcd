// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "tracing/model/findings/finders.hpp"
#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

// A callback must take this much longer than usual, and this long, before that is worth a look.
constexpr double kLongTailRatio = 10;
constexpr std::int64_t kLongTail = 1'000'000;
constexpr double kNotableJitter = 0.1;  // of a period
constexpr std::int64_t kLeastJitter = 100'000;
constexpr std::uint64_t kOften = 5;  // calls
constexpr double kNotablePart = 0.01;
constexpr double kDominating = 0.3;     // of the time of a thread
constexpr double kNotableDrift = 0.01;  // of a period
constexpr std::int64_t kLeastDrift = 50'000;
constexpr double kHeldUpPart = 0.05;  // of a period
constexpr std::int64_t kHeldUp = 1'000'000;

// Often, and more than once in a while.
bool is_frequent(std::uint64_t count, std::uint64_t all) {
  return count >= kOften && static_cast<double>(count) >= kNotablePart * static_cast<double>(all);
}

bool is_held_up(const CallbackResult& callback) {
  if (!callback.held_up_by_id || !is_frequent(callback.held_up, callback.durations.count)) {
    return false;
  }
  const std::int64_t each_ns = callback.held_up_ns / static_cast<std::int64_t>(callback.held_up);
  return each_ns >= kHeldUp && static_cast<double>(each_ns) >= kHeldUpPart * static_cast<double>(callback.period_ns);
}

}  // namespace

Findings overruns(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (!is_frequent(callback.overruns, callback.durations.count) &&
        (callback.overruns == 0 || callback.overruns * 4 < callback.durations.count)) {
      continue;
    }
    const double share = static_cast<double>(callback.overruns) / static_cast<double>(callback.durations.count);
    findings.push_back({Finding::Kind::kOverrun, 60 + 30 * share, label(hosts, callback),
                        fmt::format("{} of {} took longer than the period, at most {}{}", callback.overruns,
                                    format_count(callback.durations.count, "run"), duration(callback.durations.max_ns),
                                    mark(callback.doubtful)),
                        "shorten " + place_in_source(callback) + ", or give it a longer period", callback.id});
  }
  return findings;
}

Findings late_timers(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.owner != CallbackResult::Owner::kTimer || callback.jitter.count < 2 || callback.period_ns <= 0) {
      continue;
    }
    const std::int64_t off_ns = usual_worst(callback.jitter);
    const double ratio = static_cast<double>(off_ns) / static_cast<double>(callback.period_ns);
    const bool misses = is_frequent(callback.missed, callback.jitter.count + callback.missed);
    if (!misses && (ratio < kNotableJitter || off_ns < kLeastJitter)) {
      continue;
    }
    std::string figures = fmt::format("up to {} off its period, at p99 {}", duration(callback.jitter.max_ns),
                                      duration(callback.jitter.p99_ns));
    if (callback.missed > 0) {
      figures += fmt::format("; {} missed", format_count(callback.missed, "period"));
    }
    findings.push_back(
        {Finding::Kind::kWorstJitter, 20 + 50 * std::min(1.0, ratio) + (misses ? 20 : 0) + std::min(ratio, 9.0),
         label(hosts, callback), figures + mark(callback.doubtful),
         callback.held_up_by.empty() ? "record sched_switch (events-kernel): who has the processor meanwhile?"
                                     : "its thread runs " + callback.held_up_by + " meanwhile",
         callback.id});
  }
  return findings;
}

Findings long_tails(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    const DurationSummary& took = callback.durations;
    constexpr std::uint64_t kForP99 = 500;
    const std::int64_t long_ns = took.count >= kForP99 ? took.p99_ns : took.p90_ns;
    constexpr std::uint64_t kEnough = 50;
    if (took.count < kEnough || long_ns < kLongTail) {
      continue;
    }
    const double ratio = static_cast<double>(long_ns) / static_cast<double>(std::max<std::int64_t>(took.p50_ns, 1));
    if (ratio < kLongTailRatio) {
      continue;
    }
    findings.push_back({Finding::Kind::kLongTail, std::min(60.0, 20 + 10 * std::log10(ratio)), label(hosts, callback),
                        fmt::format("usually takes {}, at p99 {}, at most {}{}", duration(took.p50_ns),
                                    duration(took.p99_ns), duration(took.max_ns), mark(callback.doubtful)),
                        "what differs in the long runs of " + place_in_source(callback) + "? --html FILE shows each",
                        callback.id});
  }
  return findings;
}

Findings starved_callbacks(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.longest_runnable_ns < kLongTail) {
      continue;
    }
    const std::string other =
        callback.ran_instead.empty()
            ? ""
            : fmt::format(", which '{}' had for {}", callback.ran_instead, duration(callback.ran_instead_ns));
    const double milliseconds = static_cast<double>(callback.longest_runnable_ns) / 1e6;
    findings.push_back({Finding::Kind::kStarvedCallback,
                        at_most(95, 50 + 15 * std::log10(1 + milliseconds), milliseconds), label(hosts, callback),
                        fmt::format("waited {} for a processor{}; at p99 {}{}", duration(callback.longest_runnable_ns),
                                    other, duration(callback.runnable.p99_ns), mark(callback.doubtful)),
                        "give its process a priority, or processors of its own (cpus)", callback.id});
  }
  return findings;
}

Findings unfinished_callbacks(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.unfinished < 2) {
      continue;  // one may be the last one of the trace
    }
    findings.push_back(
        {Finding::Kind::kUnfinished,
         at_most(80, 50 + static_cast<double>(callback.unfinished), static_cast<double>(callback.unfinished)),
         label(hosts, callback),
         fmt::format("{} have no end: an exception, or lost events", format_count(callback.unfinished, "begin")),
         "look for exceptions in " + place_in_source(callback), callback.id});
  }
  return findings;
}

Findings drifting_timers(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    constexpr std::uint64_t kEnough = 10;
    if (callback.owner != CallbackResult::Owner::kTimer || callback.period_ns <= 0 ||
        is_frequent(callback.missed, callback.interval.count) ||
        is_frequent(callback.overruns, callback.interval.count) || callback.interval.count < kEnough) {
      continue;
    }
    const std::int64_t drift = std::abs(callback.interval.p50_ns - callback.period_ns);
    const double ratio = static_cast<double>(drift) / static_cast<double>(callback.period_ns);
    if (drift < kLeastDrift || ratio < kNotableDrift) {
      continue;
    }
    findings.push_back({Finding::Kind::kDriftingTimer, 35 + 50 * std::min(1.0, ratio), label(hosts, callback),
                        fmt::format("usually called after {}, {:.2g} % off its period{}",
                                    duration(callback.interval.p50_ns), 100 * ratio, mark(callback.doubtful)),
                        "is it set anew (reset()) in " + place_in_source(callback) + "?", callback.id});
  }
  return findings;
}

Findings dominating_callbacks(const TraceResults& results) {
  const Hosts hosts(results.overview);
  const TraceOverview& overview = results.overview;
  if (!overview.begin_ns || !overview.end_ns || *overview.end_ns <= *overview.begin_ns) {
    return {};
  }
  const auto span = static_cast<double>(*overview.end_ns - *overview.begin_ns);
  Findings findings;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    const double share = callback.durations.mean_ns * static_cast<double>(callback.durations.count) / span;
    if (share < kDominating || callback.durations.count < 2) {
      continue;
    }
    findings.push_back(
        {Finding::Kind::kDominatingCallback, 30 + 60 * std::min(1.0, share), label(hosts, callback),
         fmt::format("its {} take {:.2g} % of the time, usually {} each, at most {}{}",
                     format_count(callback.durations.count, "run"), 100 * share, duration(callback.durations.p50_ns),
                     duration(callback.durations.max_ns), mark(callback.doubtful)),
         "shorten " + place_in_source(callback) + ", or give it an executor of its own", callback.id});
  }
  return findings;
}

// All that wait for one callback are one finding.
Findings blocking_callbacks(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallbackResult& blocking : results.ros2.callbacks) {
    const CallbackResult* worst = nullptr;
    std::vector<std::uint32_t> concerned;
    for (const CallbackResult& callback : results.ros2.callbacks) {
      if (callback.held_up_by_id == blocking.id && is_held_up(callback)) {
        concerned.push_back(callback.id);
        if (worst == nullptr || callback.held_up_ns > worst->held_up_ns) {
          worst = &callback;
        }
      }
    }
    if (worst == nullptr) {
      continue;
    }
    std::string figures = fmt::format("holds up {} for {} each, {}", label(hosts, *worst),
                                      duration(worst->held_up_ns / static_cast<std::int64_t>(worst->held_up)),
                                      format_count(worst->held_up, "time"));
    if (worst->missed > 0) {
      figures += fmt::format(" ({} missed)", format_count(worst->missed, "period"));
    }
    if (concerned.size() > 1) {
      figures += fmt::format(", and {} more", concerned.size() - 1);
    }
    const double share =
        static_cast<double>(worst->held_up) / static_cast<double>(std::max<std::uint64_t>(worst->durations.count, 1));
    findings.push_back({Finding::Kind::kBlockingCallback,
                        45 + 30 * std::min(1.0, share) + (worst->missed > 0 ? 15 : 0),
                        label(hosts, blocking),
                        figures + mark(blocking.doubtful),
                        "give " + place_in_source(blocking) + " an executor of its own, or shorten it",
                        blocking.id,
                        {},
                        std::move(concerned)});
  }
  return findings;
}

}  // namespace tracing
