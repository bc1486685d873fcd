// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/contention.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
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

// Lengths that were recorded: those that figures count, in ascending order, and all by the time of their begin, which
// is that of a simulation.
struct RecordedLengths {
  std::vector<std::int64_t> sorted;
  std::vector<Sample> by_time;

  void add(const Distribution& lengths, const System& system) {
    const std::vector<std::int64_t> counted = lengths.values_from(system.begin_ns + system.up_ns);
    sorted.insert(sorted.end(), counted.begin(), counted.end());
    std::sort(sorted.begin(), sorted.end());
    for (const Distribution::Moment& moment : lengths.moments) {
      by_time.push_back({moment.time_ns - system.begin_ns, lengths.values[moment.place]});
    }
    std::sort(by_time.begin(), by_time.end(),
              [](const Sample& left, const Sample& right) { return left.time_ns < right.time_ns; });
  }

  // What began next to this time, if that is nearer than a quarter of the usual interval.
  std::optional<std::int64_t> at(std::int64_t time_ns) const {
    if (by_time.size() < 2) {
      return std::nullopt;
    }
    auto next =
        std::lower_bound(by_time.begin(), by_time.end(), time_ns,
                         [](const Sample& sample, std::int64_t wanted_ns) { return sample.time_ns < wanted_ns; });
    if (next == by_time.end() ||
        (next != by_time.begin() && time_ns - std::prev(next)->time_ns < next->time_ns - time_ns)) {
      --next;
    }
    const std::int64_t usual_ns =
        (by_time.back().time_ns - by_time.front().time_ns) / static_cast<std::int64_t>(by_time.size());
    return std::abs(next->time_ns - time_ns) > usual_ns / 4 ? std::nullopt : std::optional(next->value);
  }
};

// Of a callback.
struct Recorded {
  RecordedLengths ways;
  RecordedLengths runs;
};

Recorded recorded_of(const Callback& callback, const System& system) {
  Recorded recorded;
  recorded.ways.add(callback.ways, system);
  if (!system.processor_times) {
    recorded.runs.add(callback.run_times, system);
    recorded.runs.add(callback.silent_run_times, system);
  }
  return recorded;
}

void sort_by_total(std::vector<SimulatedTime>& times) {
  std::stable_sort(times.begin(), times.end(), [](const SimulatedTime& left, const SimulatedTime& right) {
    return left.total_ns < right.total_ns;
  });
}

// How far the median and the p99 are from what was recorded; 1 for each is as far as a twin may be, and more costs
// extra. Both in order.
double misfit(const std::vector<std::int64_t>& recorded, const std::vector<SimulatedTime>& simulated) {
  constexpr double kMost = 3;
  constexpr double kTooFar = 3;
  const auto of = [&](double part, double allowed) {
    const auto at = [&](std::size_t count) {
      return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(part * static_cast<double>(count))), 1, count) -
             1;
    };
    const auto was = static_cast<double>(std::max<std::int64_t>(1, recorded[at(recorded.size())]));
    const auto is = static_cast<double>(std::max<std::int64_t>(1, simulated[at(simulated.size())].total_ns));
    const double off = std::min(kMost, std::abs(std::log(is / was)) / std::log(allowed));
    return off > 1 ? off + kTooFar : off;
  };
  return recorded.empty() || simulated.empty() ? 0 : of(0.5, 1.1) + of(0.99, 1.25);
}

// What a simulated way or run should have taken.
enum class Wanted {
  kSameRank,  // the n-th of the recorded lengths, for the n-th of the simulated ones
  kSameTime,  // what was recorded at that time; what has no such time, as kSameRank
};

// Moves each time that was used nearer to what is wanted of it. `simulated` is in order.
void fit(const RecordedLengths& recorded, const std::vector<SimulatedTime>& simulated, Wanted wanted,
         const Callback& whole, Callback& callback) {
  if (recorded.sorted.empty()) {
    return;
  }
  struct Sum {
    double difference = 0;
    std::size_t count = 0;
  };
  std::map<std::pair<SimulatedTime::Source, std::uint32_t>, Sum> sums;
  for (std::size_t rank = 0; rank < simulated.size(); ++rank) {
    const SimulatedTime& time = simulated[rank];
    const std::int64_t of_rank = recorded.sorted[(2 * rank + 1) * recorded.sorted.size() / (2 * simulated.size())];
    const std::int64_t wanted_ns = wanted == Wanted::kSameTime ? recorded.at(time.begin_ns).value_or(of_rank) : of_rank;
    Sum& sum = sums[{time.source, time.place}];
    sum.difference += static_cast<double>(wanted_ns - time.total_ns);
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
      recorded_.push_back(recorded_of(callback, system));
    }
  }

  void run(System system, Wanted wanted) {
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
        sum += misfit(recorded.ways.sorted, times.ways) + misfit(recorded.runs.sorted, times.runs);
        fit(recorded.ways, times.ways, wanted, whole_[index], next[index]);
        fit(recorded.runs, times.runs, wanted, whole_[index], next[index]);
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
    for (const Wanted wanted : {Wanted::kSameRank, Wanted::kSameTime}) {
      rounds.run(system, wanted);
    }
  }
  system = rounds.best();
}

}  // namespace tracing::twin
