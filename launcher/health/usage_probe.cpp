// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/usage_probe.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>

namespace launch {

namespace {

double seconds_of(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Look MemoryProbe::look(Duration, Duration passed) {
  const std::optional<ProcessUsage> usage = usage_(pid_);
  if (!usage) {
    return {};  // it ends
  }
  ran_ += passed;
  if (!first_ && ran_ >= start_period_) {
    first_ = usage->memory;
  }
  const bool is_large = limits_.most && usage->memory > *limits_.most;
  const bool has_grown =
      limits_.most_growth && first_ && usage->memory > *first_ && usage->memory - *first_ > *limits_.most_growth;
  if (!is_large && !has_grown) {
    above_ = Duration{0};
    return {Look::Result::kGood};
  }
  above_ += passed;
  if (above_ < timeout_) {
    return {Look::Result::kGood};
  }
  const std::string what = is_large ? fmt::format("it has had more than {} of memory", size_text(*limits_.most))
                                    : fmt::format("its memory has been more than {} above {}",
                                                  size_text(*limits_.most_growth), size_text(*first_));
  return {Look::Result::kBad,
          fmt::format("{} for {:.1f} s, now {}", what, seconds_of(above_), size_text(usage->memory))};
}

Look LoadProbe::look(Duration, Duration passed) {
  const std::optional<ProcessUsage> usage = usage_(pid_);
  if (!usage) {
    return {};
  }
  const double used = usage->cpu - used_.value_or(usage->cpu);
  const bool is_first = !used_;
  used_ = usage->cpu;
  if (is_first || passed == Duration{0}) {
    return {};  // what was used in a time that does not count does not count either
  }
  newest_.push_back({passed, used});
  Duration time{0};
  double sum = 0;
  for (const Part& part : newest_) {
    time += part.passed;
    sum += part.used;
  }
  while (time - newest_.front().passed >= timeout_) {
    time -= newest_.front().passed;
    sum -= newest_.front().used;
    newest_.pop_front();
  }
  if (time < timeout_) {
    return {};
  }
  const double load = sum / seconds_of(time);
  if (load <= limit_.most) {
    return {Look::Result::kGood};
  }
  constexpr double kPercent = 100;
  return {Look::Result::kBad,
          fmt::format("it has used {:.0f} % of a processor for {:.1f} s", load * kPercent, seconds_of(time))};
}

}  // namespace launch
