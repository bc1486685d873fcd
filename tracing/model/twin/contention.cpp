// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/contention.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "tracing/model/twin/simulation.hpp"

namespace tracing::twin {

namespace {

constexpr std::size_t kMostRounds = 48;
constexpr std::size_t kLeastRounds = 4;
constexpr std::size_t kRunsOfAllRounds = 2'500'000;
constexpr double kPart = 0.4;                      // of a difference: what is changed changes the waits of others
constexpr std::int64_t kLongest = 60'000'000'000;  // of a simulation

template <typename Of>  // Callback, or const Callback
auto& source_of(Of& callback, SimulatedTime::Source source) {
  switch (source) {
    case SimulatedTime::Source::kDelay:
      return callback.delays;
    case SimulatedTime::Source::kNearDelay:
      return callback.near_delays;
    case SimulatedTime::Source::kGap:
      return callback.gaps;
    case SimulatedTime::Source::kRun:
      return callback.run_times;
    case SimulatedTime::Source::kSilentRun:
      break;
  }
  return callback.silent_run_times;
}

// What was recorded of a callback when the system was up, in ascending order.
struct Recorded {
  std::vector<std::int64_t> ways;
  std::vector<std::int64_t> lengths;
};

Recorded recorded_of(const Callback& callback, std::int64_t up_ns) {
  Recorded recorded{callback.ways.values_from(up_ns), callback.run_times.values_from(up_ns)};
  const std::vector<std::int64_t> silent = callback.silent_run_times.values_from(up_ns);
  recorded.lengths.insert(recorded.lengths.end(), silent.begin(), silent.end());
  std::sort(recorded.lengths.begin(), recorded.lengths.end());
  return recorded;
}

void sort_by_total(std::vector<SimulatedTime>& times) {
  std::stable_sort(times.begin(), times.end(), [](const SimulatedTime& left, const SimulatedTime& right) {
    return left.total_ns < right.total_ns;
  });
}

// How far the median and the p99 are from what was recorded; 1 for each is as far as a twin may be. Both in order.
double misfit(const std::vector<std::int64_t>& recorded, const std::vector<SimulatedTime>& simulated) {
  constexpr double kMost = 3;
  const auto of = [&](double part, double allowed) {
    const auto at = [&](std::size_t count) {
      return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(part * static_cast<double>(count))), 1, count) -
             1;
    };
    const auto was = static_cast<double>(std::max<std::int64_t>(1, recorded[at(recorded.size())]));
    const auto is = static_cast<double>(std::max<std::int64_t>(1, simulated[at(simulated.size())].total_ns));
    return std::min(kMost, std::abs(std::log(is / was)) / std::log(allowed));
  };
  return recorded.empty() || simulated.empty() ? 0 : of(0.5, 1.1) + of(0.99, 1.25);
}

// Moves each time that was used so far that the n-th of the simulated totals comes nearer to the n-th recorded one.
// Both in order.
void fit(const std::vector<std::int64_t>& recorded, const std::vector<SimulatedTime>& simulated, const Callback& whole,
         Callback& callback) {
  if (recorded.empty()) {
    return;
  }
  struct Sum {
    double difference = 0;
    std::size_t count = 0;
  };
  std::map<std::pair<SimulatedTime::Source, std::uint32_t>, Sum> sums;
  for (std::size_t rank = 0; rank < simulated.size(); ++rank) {
    const SimulatedTime& time = simulated[rank];
    const std::int64_t wanted = recorded[(2 * rank + 1) * recorded.size() / (2 * simulated.size())];
    Sum& sum = sums[{time.source, time.place}];
    sum.difference += static_cast<double>(wanted - time.total_ns);
    ++sum.count;
  }
  for (const auto& [of, sum] : sums) {
    std::vector<std::int64_t>& values = source_of(callback, of.first).values;
    // Even the shortest one that was recorded may have waited, but not most of the time.
    const std::int64_t least_ns = std::max<std::int64_t>(0, source_of(whole, of.first).values.front() / 2);
    const double change = kPart * sum.difference / static_cast<double>(sum.count);
    values[of.second] = std::max<std::int64_t>(least_ns, values[of.second] + std::llround(change));
  }
}

// Rounds of simulations, each of which fits the times better. Keeps the best one.
class Rounds {
 public:
  explicit Rounds(const System& system) : whole_(system.callbacks), best_(system) {
    for (const Callback& callback : whole_) {
      recorded_.push_back(recorded_of(callback, system.begin_ns + system.up_ns));
      if (system.processor_times) {
        recorded_.back().lengths.clear();
      }
    }
  }

  void run(System system) {
    std::size_t rounds = kMostRounds;
    for (std::size_t round = 0; round < rounds; ++round) {
      Simulation simulation(system);
      simulation.run(std::min(system.active_ns, kLongest));
      std::vector<Callback> next = system.callbacks;
      double sum = 0;
      std::size_t runs = 0;
      for (Index index = 0; index < whole_.size(); ++index) {
        SimulatedTimes times = simulation.times()[index];
        sort_by_total(times.ways);
        sort_by_total(times.runs);
        const Recorded& recorded = recorded_[index];
        sum += misfit(recorded.ways, times.ways) + misfit(recorded.lengths, times.runs);
        fit(recorded.ways, times.ways, whole_[index], next[index]);
        fit(recorded.lengths, times.runs, whole_[index], next[index]);
        runs += times.runs.size();
      }
      if (sum < least_) {
        least_ = sum;
        best_.callbacks = system.callbacks;
        best_.slack = system.slack;
      }
      system.callbacks = std::move(next);
      rounds = std::clamp(kRunsOfAllRounds / std::max<std::size_t>(1, runs), kLeastRounds, kMostRounds);
    }
  }

  const System& best() const { return best_; }

 private:
  std::vector<Callback> whole_;
  std::vector<Recorded> recorded_;
  System best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void take_off_simulated_waits(System& system) {
  Rounds rounds(system);
  for (const double slack : {0.6, 1.0, 1.5}) {
    system.slack = slack;
    rounds.run(system);
  }
  system = rounds.best();
}

}  // namespace tracing::twin
