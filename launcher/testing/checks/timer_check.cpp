// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "launcher/testing/checks/trace_judges.hpp"

namespace launch {

namespace {

using launch_trace_testing::CallbackRun;
using launch_trace_testing::Trace;

struct Interval {
  std::int64_t begin_ns;
  std::int64_t length_ns;
};

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) / 1e6;
}

// From each begin of a timer's callback to its next one.
std::vector<Interval> intervals_of(const ExpectedTimer& expected, const Trace& trace) {
  std::map<std::tuple<std::int64_t, std::string>, std::int64_t> last;
  std::vector<Interval> intervals;
  for (const CallbackRun& run : trace.callbacks()) {
    if (!run.is_timer || run.node != expected.node || run.period_ns != expected.period.count()) {
      continue;
    }
    const auto [before, is_first] = last.try_emplace({run.vpid, run.symbol}, run.start_ns);
    if (!is_first) {
      intervals.push_back({before->second, run.start_ns - before->second});
      before->second = run.start_ns;
    }
  }
  return intervals;
}

std::vector<std::string> timers_of(const Trace& trace) {
  std::set<std::string> timers;
  for (const CallbackRun& run : trace.callbacks()) {
    if (run.is_timer) {
      timers.insert(fmt::format("{:g} ms of {}", milliseconds(run.period_ns), run.node));
    }
  }
  return {timers.begin(), timers.end()};
}

std::vector<std::string> table_of(std::vector<Interval> intervals, std::int64_t period, const Trace& trace) {
  constexpr std::size_t kRows = 8;
  const auto difference = [period](const Interval& interval) { return std::abs(interval.length_ns - period); };
  std::stable_sort(intervals.begin(), intervals.end(),
                   [&](const Interval& a, const Interval& b) { return difference(a) > difference(b); });
  intervals.resize(std::min(intervals.size(), kRows));
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.begin_ns < b.begin_ns; });
  std::vector<std::string> rows;
  for (const Interval& interval : intervals) {
    rows.push_back(fmt::format("+{:.9f}  {:.3f} ms", static_cast<double>(interval.begin_ns - trace.begin_ns()) / 1e9,
                               milliseconds(interval.length_ns)));
  }
  return rows;
}

}  // namespace

std::optional<Failure> judge_timer(const ExpectedTimer& expected, const Trace& trace, const SourceRange& where) {
  const std::int64_t period = expected.period.count();
  const std::string timer = fmt::format("the timer of {:g} ms of '{}'", milliseconds(period), expected.node);
  const std::vector<Interval> intervals = intervals_of(expected, trace);
  if (intervals.empty()) {
    return Failure{fmt::format("{} has not fired twice", timer),
                   where,
                   "two runs of it at least",
                   "fewer",
                   timers_of(trace),
                   "the timers of the trace"};
  }
  std::uint64_t missed = 0;
  std::size_t outside = 0;
  for (const Interval& interval : intervals) {
    missed += static_cast<std::uint64_t>(std::max<std::int64_t>(
        std::llround(static_cast<double>(interval.length_ns) / static_cast<double>(period)) - 1, 0));
    outside += expected.jitter && std::abs(interval.length_ns - period) > expected.jitter->count() ? 1U : 0U;
  }
  if (missed > expected.most_missed) {
    return Failure{fmt::format("{} has missed periods", timer),
                   where,
                   fmt::format("at most {}", expected.most_missed),
                   fmt::format("{} missed, beside {} intervals", missed, intervals.size()),
                   table_of(intervals, period, trace),
                   "the longest intervals"};
  }
  const double allowed = (100 - expected.percentile) / 100 * static_cast<double>(intervals.size()) + 1e-6;
  if (static_cast<double>(outside) > allowed) {
    return Failure{fmt::format("{} does not keep its period", timer),
                   where,
                   fmt::format("{:g} % of the intervals within {:g} ms of it", expected.percentile,
                               milliseconds(expected.jitter->count())),
                   fmt::format("{} of {} intervals outside", outside, intervals.size()),
                   table_of(intervals, period, trace),
                   "the worst intervals"};
  }
  return std::nullopt;
}

}  // namespace launch
