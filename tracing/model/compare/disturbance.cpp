// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/disturbance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tracing/model/compare/peers.hpp"
#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

std::vector<double> of_others(const Disturbances& run, const Measurement& self) {
  std::vector<double> others;
  for (const auto& [subject, times] : run) {
    const bool is_self = self.kind == Kind::kCallback && subject == self.subject;
    if (!is_self && std::find(self.steps.begin(), self.steps.end(), subject) == self.steps.end()) {
      others.push_back(times.spread);
    }
  }
  return others;
}

std::array<double, 2> longest_two_of_others(const Disturbances& run, const Measurement& self) {
  std::vector<double> durations = {0, 0};
  for (const auto& [subject, times] : run) {
    if (self.kind != Kind::kCallback || subject != self.subject) {
      durations.push_back(times.median_ns);
    }
  }
  std::partial_sort(durations.begin(), durations.begin() + 2, durations.end(), std::greater<>());
  return {durations[0], durations[1]};
}

double exceeded_by_a_fifth(std::vector<double>& ratios) {
  return ratios.empty() ? 0 : quantile(ratios, 0.8);
}

}  // namespace

Disturbances disturbances_of(const RunSummary& run) {
  constexpr std::size_t kEnough = 20;
  Disturbances found;
  for (const Measurement& one : run.measurements) {
    // Of two works of a callback, the longer one is what others may have to wait for.
    const bool is_duration = one.quantity == kDuration || one.quantity == std::string(kDuration) + kWithoutSending;
    if (one.kind != Kind::kCallback || !is_duration || one.samples.size() < kEnough) {
      continue;
    }
    std::vector<double> samples(one.samples.begin(), one.samples.end());
    const double high = quantile(samples, 0.9);
    const double low = quantile(samples, 0.1);
    const CallbackTimes times{std::log(std::max(high, 1.0) / std::max(low, 1.0)), quantile(samples, 0.5)};
    const auto [known, is_new] = found.emplace(one.subject, times);
    if (!is_new && times.median_ns > known->second.median_ns) {
      known->second = times;
    }
  }
  return found;
}

Disturbance disturbance_between(const Disturbances& before, const Disturbances& after, const Measurement& self) {
  std::vector<double> earlier = of_others(before, self);
  std::vector<double> later = of_others(after, self);
  const bool by_few = std::min(earlier.size(), later.size()) < kLeastPeers;
  if (by_few) {
    earlier.clear();
    for (const auto& [subject, times] : before) {
      earlier.push_back(times.spread);
    }
  }
  const std::array<double, 2> then = longest_two_of_others(before, self);
  const std::array<double, 2> now = longest_two_of_others(after, self);
  const double longest = std::min(then[0], now[0]);
  return {std::max(exceeded_by_a_fifth(earlier), exceeded_by_a_fifth(later)), by_few, longest,
          std::min(then[0] + then[1], now[0] + now[1])};
}

}  // namespace tracing::compare
