// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "tracing/model/compare/blocks.hpp"
#include "tracing/model/compare/peers.hpp"

namespace tracing::compare {

namespace {

using Key = std::tuple<Kind, std::string, std::string>;
using Found = std::vector<const Measurement*>;  // of one side, one for each run that has it

std::map<Key, Found> by_key(const Runs& side) {
  std::map<Key, Found> found;
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
  return statistic == Statistic::kMedian ? 0.5 : 0.9;
}

// Late calls are no change of a rate, and a busy machine has many of them.
std::vector<Statistic> statistics_of(const std::string& quantity) {
  if (quantity == "interval") {
    return {Statistic::kMedian};
  }
  return {Statistic::kMedian, Statistic::kP90};
}

// One statistic of a quantity in one run before and one run after.
struct PairTest {
  BlockPair blocks;
  double before = 0;
  double shift = 0;
};

// One statistic of a quantity that both sides have.
struct Tested {
  Key key;
  const Found* before = nullptr;
  const Found* after = nullptr;
  Statistic statistic = Statistic::kMedian;
  std::vector<PairTest> pairs;  // every run before with every run after
  double more = 0;              // the probability that the value is not larger by more than what counts
  double less = 0;
};

// Returns false when a run has too few samples.
bool cut(Tested& tested) {
  const std::size_t least_length = tested.statistic == Statistic::kMedian ? 5 : 10;
  for (const Measurement* earlier : *tested.before) {
    for (const Measurement* later : *tested.after) {
      std::optional<BlockPair> blocks =
          cut_into_blocks(earlier->samples, later->samples, share_of(tested.statistic), least_length);
      if (!blocks) {
        return false;
      }
      std::vector<double> before = blocks->before;
      std::vector<double> after = blocks->after;
      PairTest pair{std::move(*blocks), quantile(before, 0.5), 0};
      pair.shift = quantile(after, 0.5) - pair.before;
      tested.pairs.push_back(std::move(pair));
    }
  }
  return true;
}

std::vector<double> moved(std::vector<double> values, double by) {
  for (double& value : values) {
    value += by;
  }
  return values;
}

// Tests one pair of runs of quantities that are of one sort, `place` of their pairs.
void test_pair(const std::vector<Tested*>& sort, std::size_t place, const CompareOptions& options) {
  // So many times the spread of others are reached by chance less often than the confidence allows, even if the
  // distribution has more outliers than a normal one.
  constexpr double kSpreads = 6;
  std::vector<Shifted> shifts;
  for (const Tested* tested : sort) {
    shifts.push_back({tested->pairs[place].before, tested->pairs[place].shift});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(shifts);
  for (std::size_t i = 0; i < sort.size(); ++i) {
    const PairTest& pair = sort[i]->pairs[place];
    const double least = std::max({options.least_ratio * std::abs(pair.before), static_cast<double>(options.least_ns),
                                   pair.blocks.own_spread, kSpreads * peers[i].spread});
    const double raised = std::max(peers[i].usual, 0.0) + least;
    const double lowered = std::max(-peers[i].usual, 0.0) + least;
    sort[i]->more = std::max(sort[i]->more, rank_probability(pair.blocks.before, moved(pair.blocks.after, -raised)));
    sort[i]->less = std::max(sort[i]->less, rank_probability(moved(pair.blocks.after, lowered), pair.blocks.before));
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
  if (ratios.size() < kLeastPeers) {
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
  const std::map<Key, Found> earlier = by_key(before);
  const std::map<Key, Found> later = by_key(after);
  std::set<std::pair<Kind, std::string>> subjects;
  std::vector<Tested> tests;
  for (const auto& [key, found] : earlier) {
    const auto other = later.find(key);
    if (other == later.end()) {
      continue;
    }
    const auto& [kind, subject, quantity] = key;
    subjects.insert({kind, subject});
    bool enough = false;
    for (const Statistic statistic : statistics_of(quantity)) {
      Tested tested{key, &found, &other->second, statistic};
      if (!cut(tested)) {
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
  std::vector<double> probabilities;
  for (const Tested& tested : tests) {
    probabilities.push_back(std::min(1.0, 2 * std::min(tested.more, tested.less)));
  }
  probabilities = corrected_for_many(probabilities);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (probabilities[i] > 1 - options.confidence) {
      continue;
    }
    result.changes.push_back(change_of(tests[i], probabilities[i], options));
  }
  find_changed_steps(result.changes, before);
  result.overall = overall_of(tests, options);
  result.gone = lone_subjects(before, after);
  result.added = lone_subjects(after, before);
  return result;
}

}  // namespace tracing::compare
