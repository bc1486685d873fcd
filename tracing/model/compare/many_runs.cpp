// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/many_runs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracing/model/compare/peers.hpp"
#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

// The runs of one side: the logarithm of the value of each, and the values of their tenths.
struct RunValues {
  std::vector<double> runs;
  std::vector<double> tenths;
};

RunValues values_of(const Found& side, Statistic statistic) {
  constexpr std::size_t kTenths = 10;
  const double share = share_of(statistic);
  RunValues values;
  for (const Measurement* one : side) {
    std::vector<double> samples(one->samples.begin(), one->samples.end());
    for (std::size_t tenth = 0; tenth < kTenths; ++tenth) {
      std::vector<double> part(samples.begin() + static_cast<std::ptrdiff_t>(samples.size() * tenth / kTenths),
                               samples.begin() + static_cast<std::ptrdiff_t>(samples.size() * (tenth + 1) / kTenths));
      values.tenths.push_back(quantile(part, share));
    }
    values.runs.push_back(std::log(std::max(quantile(samples, share), 1.0)));
  }
  return values;
}

// The probability that `higher` is not higher than `lower` by this ratio, whose logarithm it is: 1, unless three
// quarters of all pairs of runs differ by it. A run that is unlike all others is in a quarter of them at most.
double probability(const RunValues& lower, const RunValues& higher, double ratio) {
  std::size_t pairs = 0;
  for (const double low : lower.runs) {
    for (const double high : higher.runs) {
      pairs += high - low > ratio ? 1 : 0;
    }
  }
  if (4 * pairs < 3 * lower.runs.size() * higher.runs.size()) {
    return 1;
  }
  std::vector<double> lowered;
  for (const double value : higher.tenths) {
    lowered.push_back(value / std::exp(ratio));
  }
  return rank_probability(lower.tenths, lowered);
}

}  // namespace

bool has_many_runs(const TestedQuantity& tested) {
  constexpr std::size_t kMany = 4;
  return tested.is_undisturbed() && tested.runs() >= kMany;
}

void test_many_runs(const std::vector<TestedQuantity*>& sort, const CompareOptions& options) {
  std::vector<std::pair<RunValues, RunValues>> sides;
  std::vector<Shifted> shifts;  // of the runs in the middle
  for (const TestedQuantity* tested : sort) {
    sides.emplace_back(values_of(*tested->before, tested->statistic), values_of(*tested->after, tested->statistic));
    std::vector<double> before = sides.back().first.runs;
    std::vector<double> after = sides.back().second.runs;
    const double middle = quantile(before, 0.5);
    shifts.push_back({std::exp(middle), quantile(after, 0.5) - middle});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(shifts);
  // Runs in the middle have no outliers, so fewer spreads are enough than for a pair of runs.
  constexpr double kSpreads = 6;
  for (std::size_t i = 0; i < sort.size(); ++i) {
    const double least = least_change(shifts[i].before, options);
    const auto test = [&](double spreads) {
      const double counts = std::max(least, spreads * peers[i].spread);
      const auto& [before, after] = sides[i];
      return TestedQuantity::Sides{probability(before, after, counts + std::max(peers[i].usual, 0.0)),
                                   probability(after, before, counts + std::max(-peers[i].usual, 0.0))};
    };
    sort[i]->certain = test(kSpreads);
    sort[i]->likely = test(kSpreads / 2);
  }
}

}  // namespace tracing::compare
