// SPDX-License-Identifier: Apache-2.0
// Whether a statistic of a quantity differs between runs by more than what counts (docs/comparing_runs.md, "The
// method").
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tracing/model/compare/blocks.hpp"
#include "tracing/model/compare/compare_options.hpp"
#include "tracing/model/compare/disturbance.hpp"
#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

using Key = std::tuple<Kind, std::string, std::string>;
using Found = std::vector<const Measurement*>;  // of one side, one for each run that has it

// One statistic of a quantity in one run before and one run after.
struct PairTest {
  BlockPair blocks;
  double before = 0;
  double shift = 0;
  double ratio = 0;  // its logarithm
  Disturbance disturbance;
};

// One statistic of a quantity that both sides have.
struct TestedQuantity {
  Key key;
  const Found* before = nullptr;
  const Found* after = nullptr;
  Statistic statistic = Statistic::kMedian;
  std::vector<PairTest> pairs;  // every run before with every run after
  // The probability that the value is not larger (or smaller) by more than what counts; `likely`: than half of what the
  // runs may differ.
  struct Sides {
    double more = 0;
    double less = 0;
    double of_either() const { return std::min(1.0, 2 * std::min(more, less)); }
  };
  Sides certain;
  Sides likely;

  // The fastest runs of a callback are those that nothing delayed, and the kernel knows how long each of them ran.
  bool is_undisturbed() const {
    return std::get<Kind>(key) == Kind::kCallback &&
           (statistic == Statistic::kP10 || std::get<2>(key).starts_with(kRunning));
  }
  std::size_t runs() const { return std::min(before->size(), after->size()); }  // of the side that has fewer
};

// The share of the samples below the statistic: 0.1, 0.5, 0.9.
double share_of(Statistic statistic);

// Late calls are no change of a rate, and a busy machine has many of them. How long a callback waited or slept explains
// its duration, and is not tested.
std::vector<Statistic> statistics_of(const std::string& quantity);

// Cuts all pairs of runs into blocks. Returns false when a run has too few samples. `disturbances`: of the run of each
// measurement.
bool cut(TestedQuantity& tested, const std::map<const Measurement*, const Disturbances*>& disturbances);

// What counts for the user, as the logarithm of a ratio. `before`: nanoseconds.
double least_change(double before, const CompareOptions& options);

}  // namespace tracing::compare
