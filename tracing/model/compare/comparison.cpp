// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "tracing/model/compare/blocks.hpp"
#include "tracing/model/compare/change_cause.hpp"
#include "tracing/model/compare/disturbance.hpp"
#include "tracing/model/compare/peers.hpp"

namespace tracing::compare {

namespace {

using Key = std::tuple<Kind, std::string, std::string>;
using Found = std::vector<const Measurement*>;  // of one side, one for each run that has it

using AllFound = std::map<Key, Found>;

AllFound by_key(const Runs& side) {
  AllFound found;
  for (const RunSummary& run : side.runs) {
    for (const Measurement& one : run.measurements) {
      found[{one.kind, one.subject, one.quantity}].push_back(&one);
    }
  }
  return found;
}

double value_of(const Found& side, double share) {
  std::vector<double> samples;
  for (const Measurement* one : side) {
    samples.insert(samples.end(), one->samples.begin(), one->samples.end());
  }
  return quantile(samples, share);
}

bool is_doubtful(const Found& side) {
  return std::any_of(side.begin(), side.end(), [](const Measurement* one) { return one->doubtful; });
}

double share_of(Statistic statistic) {
  constexpr double kShares[] = {0.1, 0.5, 0.9};
  return kShares[static_cast<std::size_t>(statistic)];
}

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

// Late calls are no change of a rate, and a busy machine has many of them. How long a callback waited or slept explains
// its duration, and is not tested.
std::vector<Statistic> statistics_of(const std::string& quantity) {
  if (quantity == "interval") {
    return {Statistic::kMedian};
  }
  if (quantity == kWaiting || quantity == kBlocked) {
    return {};
  }
  return {Statistic::kP10, Statistic::kMedian, Statistic::kP90};
}

// One statistic of a quantity in one run before and one run after.
struct PairTest {
  BlockPair blocks;
  double before = 0;
  double shift = 0;
  double ratio = 0;  // its logarithm
  Disturbance disturbance;
};

// One statistic of a quantity that both sides have.
struct Tested {
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
    return std::get<Kind>(key) == Kind::kCallback && (statistic == Statistic::kP10 || std::get<2>(key) == kRunning);
  }
};

// Returns false when a run has too few samples.
bool cut(Tested& tested, const std::map<const Measurement*, const Disturbances*>& disturbances) {
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

// What two runs may differ without a change that counts: the larger one of a ratio (its logarithm) and a time.
struct Noise {
  double ratio = 0;
  double ns = 0;
};

// `least`: what the user cares for, as the logarithm of a ratio.
void test_sides(Tested::Sides& sides, const PairTest& pair, double usual, const Noise& noise, double least) {
  const double larger = std::exp(std::max(usual, 0.0) + std::max(noise.ratio, least));
  const double smaller = std::exp(std::max(-usual, 0.0) + std::max(noise.ratio, least));
  std::vector<double> lowered;
  std::vector<double> raised;
  for (const double value : pair.blocks.after) {
    lowered.push_back(std::min(value / larger, value - noise.ns));
    raised.push_back(std::max(value * smaller, value + noise.ns));
  }
  sides.more = std::max(sides.more, rank_probability(pair.blocks.before, lowered));
  sides.less = std::max(sides.less, rank_probability(raised, pair.blocks.before));
}

// What the machine may delay a quantity by in one of the runs, as the logarithm of a ratio. `certainly`: half of it is
// enough for what is likely, if many callbacks tell it.
double delay_of(const Tested& tested, const PairTest& pair, bool certainly) {
  if (tested.is_undisturbed()) {
    return 0;
  }
  // A delay that a fifth of the callbacks has sometimes may hit the same one each time.
  const double twice = 2 * pair.disturbance.ratio;
  if (!pair.disturbance.by_few) {
    return certainly ? twice : twice / 2;
  }
  // A few callbacks tell their own work as much as the machine, so no more counts than runs of small systems differ by.
  // Latencies, which are the machine's, differ by more than work, and by what the tenths of the run before do.
  const bool is_work = std::get<Kind>(tested.key) == Kind::kCallback;
  return std::min(twice, is_work ? std::log(1.5) : std::max(std::log(3.0), pair.blocks.own_range));
}

// What other callbacks may add to a quantity for a whole run, because the phases of timers put them in the way each
// time: seldom more than two of them, and most likely one. A single run may have met such phases, though many
// others have not. Where both sides have several runs, a change that holds between every two is none of this kind.
double in_the_way_of(const Tested& tested, const PairTest& pair, bool certainly) {
  const bool is_delayed = !tested.is_undisturbed() && std::get<2>(tested.key) != "interval";
  constexpr std::size_t kSeveral = 3;
  if (!is_delayed || std::min(tested.before->size(), tested.after->size()) >= kSeveral) {
    return 0;
  }
  return certainly ? pair.disturbance.longest_two_ns : pair.disturbance.longest_ns;
}

// Tests one pair of runs of quantities that are of one sort, `place` of their pairs.
void test_pair(const std::vector<Tested*>& sort, std::size_t place, const CompareOptions& options) {
  // So many times the spread of others are reached by chance less often than the confidence allows, even if the
  // distribution has more outliers than a normal one.
  constexpr double kSpreads = 8;
  std::vector<Shifted> shifts;
  for (const Tested* tested : sort) {
    shifts.push_back({tested->pairs[place].before, tested->pairs[place].ratio});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(shifts);
  for (std::size_t i = 0; i < sort.size(); ++i) {
    const PairTest& pair = sort[i]->pairs[place];
    const double least =
        std::log1p(std::max(options.least_ratio, static_cast<double>(options.least_ns) / std::max(pair.before, 1.0)));
    const double spread = kSpreads * peers[i].spread;
    const double ns = kSpreads * peers[i].spread_ns;
    const double certain = std::max({spread, delay_of(*sort[i], pair, true), pair.blocks.own_ratio});
    const double likely = std::max({spread / 2, delay_of(*sort[i], pair, false), pair.blocks.own_ratio});
    const double certain_ns = std::max(ns, in_the_way_of(*sort[i], pair, true));
    const double likely_ns = std::max(ns / 2, in_the_way_of(*sort[i], pair, false));
    test_sides(sort[i]->certain, pair, peers[i].usual, {certain, certain_ns}, least);
    test_sides(sort[i]->likely, pair, peers[i].usual, {likely, likely_ns}, least);
  }
}

void test_all(std::vector<Tested>& tests, const CompareOptions& options) {
  // Quantities of one sort that were cut into the same number of pairs.
  std::map<std::tuple<Kind, std::string, Statistic, std::size_t>, std::vector<Tested*>> sorts;
  for (Tested& tested : tests) {
    const auto& [kind, subject, quantity] = tested.key;
    sorts[{kind, quantity, tested.statistic, tested.pairs.size()}].push_back(&tested);
  }
  for (const auto& [sort, members] : sorts) {
    for (std::size_t place = 0; place < std::get<3>(sort); ++place) {
      test_pair(members, place, options);
    }
  }
}

Change change_of(const Tested& tested, double probability, const CompareOptions& options) {
  Change change;
  std::tie(change.kind, change.subject, change.quantity) = tested.key;
  change.statistic = tested.statistic;
  change.probability = probability;
  change.before_ns = value_of(*tested.before, share_of(tested.statistic));
  change.after_ns = value_of(*tested.after, share_of(tested.statistic));
  change.doubtful = is_doubtful(*tested.before) || is_doubtful(*tested.after);
  // Of several pairs of runs the smallest shift is told, with an interval that holds those of all pairs.
  std::optional<Shift> told;
  for (const PairTest& pair : tested.pairs) {
    const Shift shift = shift_between(pair.blocks.before, pair.blocks.after, options.confidence);
    if (!told) {
      told = shift;
    }
    if (std::abs(shift.estimate) < std::abs(told->estimate)) {
      told->estimate = shift.estimate;
    }
    told->low = std::min(told->low, shift.low);
    told->high = std::max(told->high, shift.high);
  }
  change.shift = told.value_or(Shift{});
  return change;
}

// All callbacks together: how many take longer, and how much the one in the middle.
std::optional<Overall> overall_of(const std::vector<Tested>& tests, const CompareOptions& options) {
  std::vector<double> ratios;
  for (const Tested& tested : tests) {
    const bool is_duration = std::get<Kind>(tested.key) == Kind::kCallback && std::get<2>(tested.key) == "duration";
    if (!is_duration || tested.statistic != Statistic::kMedian) {
      continue;
    }
    std::vector<double> of_pairs;
    for (const PairTest& pair : tested.pairs) {
      of_pairs.push_back(pair.shift / std::max(pair.before, 1.0));
    }
    ratios.push_back(quantile(of_pairs, 0.5));
  }
  Overall overall;
  overall.callbacks = ratios.size();
  overall.slower =
      static_cast<std::size_t>(std::count_if(ratios.begin(), ratios.end(), [](double r) { return r > 0; }));
  constexpr std::size_t kEnough = 10;
  if (ratios.size() < kEnough) {
    return std::nullopt;
  }
  overall.ratio = quantile(ratios, 0.5);
  const std::size_t same_way = overall.ratio > 0 ? overall.slower : overall.callbacks - overall.slower;
  const bool holds = sign_probability(same_way, overall.callbacks) <= 1 - options.confidence;
  return holds && std::abs(overall.ratio) >= options.least_ratio ? std::optional(overall) : std::nullopt;
}

// Subjects that one side has in every run, and the other side in none.
std::vector<Lone> lone_subjects(const Runs& side, const Runs& other) {
  std::map<std::pair<Kind, std::string>, std::set<const RunSummary*>> runs_with;
  for (const RunSummary& run : side.runs) {
    for (const Measurement& one : run.measurements) {
      runs_with[{one.kind, one.subject}].insert(&run);
    }
  }
  for (const RunSummary& run : other.runs) {
    for (const Measurement& one : run.measurements) {
      runs_with.erase({one.kind, one.subject});
    }
  }
  std::vector<Lone> lone;
  for (const auto& [subject, runs] : runs_with) {
    if (runs.size() == side.runs.size()) {
      lone.push_back({subject.first, subject.second});
    }
  }
  return lone;
}

void find_changed_steps(std::vector<Change>& changes, const Runs& before) {
  std::map<std::string, bool> slower;  // callbacks whose durations have changed
  for (const Change& change : changes) {
    if (change.kind == Kind::kCallback && change.quantity == "duration") {
      slower[change.subject] = change.is_slower();
    }
  }
  std::map<std::string, const std::vector<std::string>*> steps;
  for (const RunSummary& run : before.runs) {
    for (const Measurement& one : run.measurements) {
      if (one.kind == Kind::kChain) {
        steps[one.subject] = &one.steps;
      }
    }
  }
  for (Change& change : changes) {
    if (change.kind != Kind::kChain) {
      continue;
    }
    for (const std::string& step : *steps[change.subject]) {
      const auto found = slower.find(step);
      if (found != slower.end() && found->second == change.is_slower()) {
        change.changed_steps.push_back(step);
      }
    }
  }
}

}  // namespace

Comparison compare(const Runs& before, const Runs& after, const CompareOptions& options) {
  Comparison result;
  const AllFound earlier = by_key(before);
  const AllFound later = by_key(after);
  std::set<std::pair<Kind, std::string>> subjects;
  std::vector<Disturbances> of_runs;
  of_runs.reserve(before.runs.size() + after.runs.size());
  std::map<const Measurement*, const Disturbances*> disturbances;  // of its run
  for (const Runs* side : {&before, &after}) {
    for (const RunSummary& run : side->runs) {
      of_runs.push_back(disturbances_of(run));
      for (const Measurement& one : run.measurements) {
        disturbances[&one] = &of_runs.back();
      }
    }
  }
  std::vector<Tested> tests;
  for (const auto& [key, found] : earlier) {
    const auto other = later.find(key);
    if (other == later.end()) {
      continue;
    }
    const auto& [kind, subject, quantity] = key;
    subjects.insert({kind, subject});
    const std::vector<Statistic> statistics = statistics_of(quantity);
    bool enough = statistics.empty();
    for (const Statistic statistic : statistics) {
      Tested tested{key, &found, &other->second, statistic};
      if (!cut(tested, disturbances)) {
        continue;
      }
      enough = true;
      tests.push_back(std::move(tested));
    }
    if (!enough) {
      ++result.too_few_samples;
    }
  }
  result.compared = subjects.size();
  result.tests = tests.size();

  test_all(tests, options);
  std::vector<double> certain;
  std::vector<double> likely;
  for (const Tested& tested : tests) {
    certain.push_back(tested.certain.of_either());
    likely.push_back(tested.likely.of_either());
  }
  certain = corrected_for_many(certain);
  likely = corrected_for_many(likely);
  const auto change = [&](std::size_t test, double probability) {
    Change one = change_of(tests[test], probability, options);
    if (one.kind == Kind::kCallback && one.quantity == "duration") {
      one.cause = cause_of(one.subject, one.is_slower(), before, after);
    }
    return one;
  };
  std::set<std::pair<Kind, std::string>> changed;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (certain[i] <= 1 - options.confidence) {
      result.changes.push_back(change(i, certain[i]));
      changed.insert({result.changes.back().kind, result.changes.back().subject});
    }
  }
  constexpr double kLikely = 0.1;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const auto& [kind, subject, quantity] = tests[i].key;
    if (likely[i] <= kLikely && !changed.contains({kind, subject})) {
      result.likely.push_back(change(i, likely[i]));
    }
  }
  find_changed_steps(result.changes, before);
  find_changed_steps(result.likely, before);
  result.overall = overall_of(tests, options);
  result.gone = lone_subjects(before, after);
  result.added = lone_subjects(after, before);
  return result;
}

}  // namespace tracing::compare
