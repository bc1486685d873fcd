// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "tracing/model/compare/change_cause.hpp"
#include "tracing/model/compare/disturbance.hpp"
#include "tracing/model/compare/many_runs.hpp"
#include "tracing/model/compare/quantity_tests.hpp"
#include "tracing/model/compare/tested_quantity.hpp"

namespace tracing::compare {

namespace {

using AllFound = std::map<Key, Found>;

// The callbacks that send messages in some of their runs and nothing in others, on either side.
std::set<std::string> callbacks_of_two_works(const Runs& before, const Runs& after) {
  std::set<std::string> sending;
  std::set<std::string> silent;
  for (const Runs* side : {&before, &after}) {
    for (const RunSummary& run : side->runs) {
      for (const Measurement& one : run.measurements) {
        if (one.sends) {
          (*one.sends ? sending : silent).insert(one.subject);
        }
      }
    }
  }
  std::set<std::string> both;
  std::set_intersection(sending.begin(), sending.end(), silent.begin(), silent.end(), std::inserter(both, both.end()));
  return both;
}

bool is_work(const std::string& quantity) {
  return quantity.starts_with(kDuration) || quantity.starts_with(kRunning);
}

// Where a callback has two works, their durations are two quantities, even if a run has one of them alone.
std::string compared_quantity(const Measurement& one, const std::set<std::string>& of_two_works) {
  if (!is_work(one.quantity) || one.kind != Kind::kCallback || !of_two_works.contains(one.subject)) {
    return one.quantity;
  }
  if (!one.sends) {
    return one.quantity + " of all runs";  // of a former release, which nothing can be compared with
  }
  const bool is_named = one.quantity.ends_with(kWithoutSending);
  return one.quantity + (*one.sends || is_named ? "" : kWithoutSending);
}

AllFound by_key(const Runs& side, const std::set<std::string>& of_two_works) {
  AllFound found;
  for (const RunSummary& run : side.runs) {
    for (const Measurement& one : run.measurements) {
      found[{one.kind, one.subject, compared_quantity(one, of_two_works)}].push_back(&one);
    }
  }
  return found;
}

// Those that the other side does not have.
std::size_t works_of_one_side(const AllFound& side, const AllFound& other, const std::set<std::string>& of_two_works) {
  return static_cast<std::size_t>(std::count_if(side.begin(), side.end(), [&](const auto& found) {
    const auto& [kind, subject, quantity] = found.first;
    return kind == Kind::kCallback && is_work(quantity) && of_two_works.contains(subject) &&
           !other.contains(found.first);
  }));
}

// What a message waits for in a node is a matter of the phases of timers, which are others in each run. With three runs
// on both sides a change that holds between every two of them is none of these.
bool depends_on_phases(const Found& before, const Found& after) {
  constexpr std::size_t kSeveral = 3;
  const auto waits = [](const Measurement* one) { return one->waits; };
  return std::min(before.size(), after.size()) < kSeveral &&
         (std::any_of(before.begin(), before.end(), waits) || std::any_of(after.begin(), after.end(), waits));
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

bool is_estimated(const Found& side) {
  return std::any_of(side.begin(), side.end(), [](const Measurement* one) { return one->estimated; });
}

// Of several pairs of runs the smallest shift is told, with an interval that holds those of all pairs. Of many runs one
// may be unlike all others, and its pairs show nothing, or the opposite: the shift in the middle is told, with an
// interval that holds those of three quarters of the pairs.
Shift told_shift(const TestedQuantity& tested, const CompareOptions& options) {
  std::vector<double> estimates;
  std::vector<double> lows;
  std::vector<double> highs;
  for (const PairTest& pair : tested.pairs) {
    const Shift shift = shift_between(pair.blocks.before, pair.blocks.after, options.confidence);
    estimates.push_back(shift.estimate);
    lows.push_back(shift.low);
    highs.push_back(shift.high);
  }
  if (has_many_runs(tested)) {
    return {quantile(estimates, 0.5), quantile(lows, 0.125), quantile(highs, 0.875)};
  }
  return {*std::min_element(estimates.begin(), estimates.end(),
                            [](double a, double b) { return std::abs(a) < std::abs(b); }),
          *std::min_element(lows.begin(), lows.end()), *std::max_element(highs.begin(), highs.end())};
}

Change change_of(const TestedQuantity& tested, double probability, const CompareOptions& options) {
  Change change;
  std::tie(change.kind, change.subject, change.quantity) = tested.key;
  change.statistic = tested.statistic;
  change.probability = probability;
  change.before_ns = value_of(*tested.before, share_of(tested.statistic));
  change.after_ns = value_of(*tested.after, share_of(tested.statistic));
  change.doubtful = is_doubtful(*tested.before) || is_doubtful(*tested.after);
  change.estimated = is_estimated(*tested.before) || is_estimated(*tested.after);
  change.shift = told_shift(tested, options);
  return change;
}

// All callbacks together: how many take longer, and how much the one in the middle.
std::optional<Overall> overall_of(const std::vector<TestedQuantity>& tests, const CompareOptions& options) {
  std::vector<double> ratios;
  for (const TestedQuantity& tested : tests) {
    const bool is_duration = std::get<Kind>(tested.key) == Kind::kCallback && std::get<2>(tested.key) == kDuration;
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
    if (change.kind == Kind::kCallback && change.quantity.starts_with(kDuration)) {
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
  const std::set<std::string> of_two_works = callbacks_of_two_works(before, after);
  const AllFound earlier = by_key(before, of_two_works);
  const AllFound later = by_key(after, of_two_works);
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
  std::vector<TestedQuantity> tests;
  for (const auto& [key, found] : earlier) {
    const auto other = later.find(key);
    if (other == later.end()) {
      continue;
    }
    const auto& [kind, subject, quantity] = key;
    subjects.insert({kind, subject});
    if (depends_on_phases(found, other->second)) {
      ++result.undecided;
      continue;
    }
    const std::vector<Statistic> statistics = statistics_of(quantity);
    bool enough = statistics.empty();
    for (const Statistic statistic : statistics) {
      TestedQuantity tested{key, &found, &other->second, statistic};
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
  result.undecided += works_of_one_side(earlier, later, of_two_works) + works_of_one_side(later, earlier, of_two_works);
  result.compared = subjects.size();
  result.tests = tests.size();

  test_all(tests, options);
  std::vector<double> certain;
  std::vector<double> likely;
  for (const TestedQuantity& tested : tests) {
    certain.push_back(tested.certain.of_either());
    likely.push_back(tested.likely.of_either());
  }
  certain = corrected_for_many(certain);
  likely = corrected_for_many(likely);
  const auto change = [&](std::size_t test, double probability) {
    Change one = change_of(tests[test], probability, options);
    // Of two works, only the running times are known apart.
    if (one.kind == Kind::kCallback && one.quantity == kDuration && !of_two_works.contains(one.subject)) {
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
