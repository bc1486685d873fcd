// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/tested_quantity.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

// `samples`: of the run that has fewer. The lowest of two or three samples is seldom one that was disturbed.
BlockRule rule_of(Statistic statistic, std::size_t samples) {
  switch (statistic) {
    case Statistic::kP10:
      return {share_of(statistic), samples < 30 ? std::size_t{2} : std::size_t{3}, 8};
    case Statistic::kMedian:
      return {share_of(statistic), 5, 10};
    case Statistic::kP90:
      break;
  }
  return {share_of(statistic), 10, 10};
}

}  // namespace

double share_of(Statistic statistic) {
  constexpr double kShares[] = {0.1, 0.5, 0.9};
  return kShares[static_cast<std::size_t>(statistic)];
}

std::vector<Statistic> statistics_of(const std::string& quantity) {
  if (quantity == "interval") {
    return {Statistic::kMedian};
  }
  if (quantity == kWaiting || quantity == kBlocked) {
    return {};
  }
  return {Statistic::kP10, Statistic::kMedian, Statistic::kP90};
}

bool cut(TestedQuantity& tested, const std::map<const Measurement*, const Disturbances*>& disturbances) {
  for (const Measurement* earlier : *tested.before) {
    for (const Measurement* later : *tested.after) {
      const BlockRule rule = rule_of(tested.statistic, std::min(earlier->samples.size(), later->samples.size()));
      std::optional<BlockPair> blocks = cut_into_blocks(earlier->samples, later->samples, rule);
      if (!blocks) {
        return false;
      }
      std::vector<double> before = blocks->before;
      std::vector<double> after = blocks->after;
      PairTest pair{std::move(*blocks), quantile(before, 0.5)};
      const double now = quantile(after, 0.5);
      pair.shift = now - pair.before;
      pair.ratio = std::log(std::max(now, 1.0) / std::max(pair.before, 1.0));
      pair.disturbance = disturbance_between(*disturbances.at(earlier), *disturbances.at(later), *earlier);
      tested.pairs.push_back(std::move(pair));
    }
  }
  return true;
}

double least_change(double before, const CompareOptions& options) {
  return std::log1p(std::max(options.least_ratio, static_cast<double>(options.least_ns) / std::max(before, 1.0)));
}

}  // namespace tracing::compare
