// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/contention.hpp"

#include <algorithm>

#include "tracing/model/twin/simulation.hpp"

namespace tracing::twin {

namespace {

constexpr int kRounds = 4;
constexpr std::int64_t kLongest = 60'000'000'000;  // of a simulation
constexpr std::size_t kWaits = 100;

// A few that stand for all.
std::vector<std::int64_t> few(std::vector<std::int64_t> waits) {
  std::sort(waits.begin(), waits.end());
  if (waits.size() <= kWaits) {
    return waits;
  }
  std::vector<std::int64_t> few;
  for (std::size_t place = 0; place < kWaits; ++place) {
    few.push_back(waits[(2 * place + 1) * waits.size() / (2 * kWaits)]);
  }
  return few;
}

// Changes the values so that they with any of the waits are distributed as `whole`.
void fit(const Distribution& whole, const std::vector<std::int64_t>& waits, Distribution& part) {
  if (waits.empty() || waits.back() == 0 || part.empty()) {
    return;
  }
  std::vector<std::int64_t> sums;
  sums.reserve(part.values.size() * waits.size());
  for (const std::int64_t value : part.values) {
    for (const std::int64_t wait : waits) {
      sums.push_back(value + wait);
    }
  }
  std::sort(sums.begin(), sums.end());
  for (std::size_t place = 0; place < part.values.size(); ++place) {
    const std::int64_t sum = sums[place * waits.size() + waits.size() / 2];
    // Even the shortest one that was recorded may have waited, but not most of the time.
    part.values[place] = std::max(whole.values.front() / 2, part.values[place] + whole.values[place] - sum);
  }
  std::sort(part.values.begin(), part.values.end());
}

}  // namespace

void take_off_simulated_waits(System& system) {
  const std::vector<Callback> whole = system.callbacks;
  for (int round = 0; round < kRounds; ++round) {
    Simulation simulation(system);
    simulation.run(std::min(system.active_ns, kLongest));
    for (Index index = 0; index < whole.size(); ++index) {
      const std::vector<std::int64_t> begins = few(simulation.waits()[index].begins);
      Callback& callback = system.callbacks[index];
      fit(whole[index].delays, begins, callback.delays);
      fit(whole[index].near_delays, begins, callback.near_delays);
      if (!system.processor_times) {
        const std::vector<std::int64_t> runs = few(simulation.waits()[index].runs);
        fit(whole[index].run_times, runs, callback.run_times);
        fit(whole[index].silent_run_times, runs, callback.silent_run_times);
      }
    }
  }
}

}  // namespace tracing::twin
