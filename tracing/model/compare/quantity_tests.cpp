// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/quantity_tests.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "tracing/model/compare/many_runs.hpp"
#include "tracing/model/compare/peers.hpp"
#include "tracing/model/compare/rank_test.hpp"

namespace tracing::compare {

namespace {

// What two runs may differ without a change that counts: the larger one of a ratio (its logarithm) and a time.
struct Noise {
  double ratio = 0;
  double ns = 0;
};

// `least`: what the user cares for, as the logarithm of a ratio.
void test_sides(TestedQuantity::Sides& sides, const PairTest& pair, double usual, const Noise& noise, double least) {
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
double delay_of(const TestedQuantity& tested, const PairTest& pair, bool certainly) {
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
double in_the_way_of(const TestedQuantity& tested, const PairTest& pair, bool certainly) {
  const bool is_delayed = !tested.is_undisturbed() && std::get<2>(tested.key) != "interval";
  constexpr std::size_t kSeveral = 3;
  if (!is_delayed || tested.runs() >= kSeveral) {
    return 0;
  }
  return certainly ? pair.disturbance.longest_two_ns : pair.disturbance.longest_ns;
}

// Tests one pair of runs of quantities that are of one sort, `place` of their pairs.
void test_pair(const std::vector<TestedQuantity*>& sort, std::size_t place, const CompareOptions& options) {
  // So many times the spread of others are reached by chance less often than the confidence allows, even if the
  // distribution has more outliers than a normal one.
  constexpr double kSpreads = 8;
  std::vector<Shifted> shifts;
  for (const TestedQuantity* tested : sort) {
    shifts.push_back({tested->pairs[place].before, tested->pairs[place].ratio});
  }
  const std::vector<PeerShift> peers = shifts_of_peers(shifts);
  for (std::size_t i = 0; i < sort.size(); ++i) {
    const PairTest& pair = sort[i]->pairs[place];
    const double least = least_change(pair.before, options);
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

}  // namespace

void test_all(std::vector<TestedQuantity>& tests, const CompareOptions& options) {
  // Quantities of one sort that as many runs of each side have.
  std::map<std::tuple<Kind, std::string, Statistic, std::size_t, std::size_t>, std::vector<TestedQuantity*>> sorts;
  for (TestedQuantity& tested : tests) {
    const auto& [kind, subject, quantity] = tested.key;
    const std::string sort = quantity.substr(0, quantity.find(kWithoutSending));
    sorts[{kind, sort, tested.statistic, tested.before->size(), tested.after->size()}].push_back(&tested);
  }
  for (const auto& [sort, members] : sorts) {
    if (has_many_runs(*members.front())) {
      test_many_runs(members, options);
      continue;
    }
    for (std::size_t place = 0; place < members.front()->pairs.size(); ++place) {
      test_pair(members, place, options);
    }
  }
}

}  // namespace tracing::compare
