// SPDX-License-Identifier: Apache-2.0
// Measures the time of a message from publish() to the callback of a subscription in another process, through the stack
// and through bare Fast DDS, and the time that recording every ros2 event adds to it.
//
// Every variant is a pair of processes. They take turns, batch by batch, so that other work on the machine affects all
// of them. Latencies are differences of CLOCK_MONOTONIC, taken just before publish() and first in the callback.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>

#include "latency_run.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"
#include "tracing_session.hpp"

namespace {

using latency::kSizes;
using Nanoseconds = std::vector<std::int64_t>;

// Two runs of the same program differ by more than the measured effect, because their memory lies in different places.
// Hence every process is started anew for each of these generations, each with its own rounds.
constexpr int kGenerations = 5;
constexpr int kRounds = 10;                    // of a generation
constexpr std::uint64_t kMessages = 50;        // of a batch
constexpr std::int64_t kPeriod = 400'000;      // nanoseconds
constexpr std::uint64_t kWarmUpMessages = 50;  // of each size

double quantile(Nanoseconds values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at) / 1e3;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The results of one size in one variant.
struct Samples {
  Nanoseconds latencies;
  std::vector<double> batch_medians;  // microseconds, one per round

  void add(const Nanoseconds& batch) {
    latencies.insert(latencies.end(), batch.begin(), batch.end());
    batch_medians.push_back(quantile(batch, 0.5));
  }
};

// A kind of program pair, with the samples of each size.
struct Variant {
  std::string name;
  std::string program;
  std::string subscriber_role;
  int domain;
  std::map<std::string, std::string> environment = {};
  std::vector<Samples> sizes = std::vector<Samples>(kSizes.size());
  std::unique_ptr<latency::Pair> pair = nullptr;  // of the current generation

  void start() {
    pair.reset();
    environment["ROS_DOMAIN_ID"] = std::to_string(domain);
    pair = std::make_unique<latency::Pair>(program, subscriber_role, environment);
  }
  Nanoseconds run(std::size_t size, std::uint64_t messages) const { return pair->run({size, messages, kPeriod}); }
};

// The difference between `variant` and `floor` in each round, in microseconds. Neighbours in time are compared, so that
// slow drifts of the machine cancel out.
std::vector<double> added(const Samples& variant, const Samples& floor) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < floor.batch_medians.size(); ++i) {
    differences.push_back(variant.batch_medians[i] - floor.batch_medians[i]);
  }
  return differences;
}

// The median of each generation, for intervals: rounds of one generation are not independent of each other.
std::vector<double> by_generation(const std::vector<double>& rounds) {
  std::vector<double> medians;
  for (auto at = rounds.begin(); at != rounds.end(); at += kRounds) {
    medians.push_back(median({at, at + kRounds}));
  }
  return medians;
}

// Asks a process that is traced like the stack.
latency::PathCosts cost_of_tracepoints_on_the_path(latency::Worker& tracepoints, std::size_t bytes) {
  latency::PathCosts costs{};
  const latency::PathRequest request{kPeriod, bytes};
  tracepoints.send(&request, sizeof request);
  tracepoints.receive(&costs, sizeof costs);
  return costs;
}

void print_table(const std::vector<const Variant*>& variants) {
  fmt::print("{:<8}", "KiB");
  for (const Variant* variant : variants) {
    fmt::print("{:>26}", variant->name);
  }
  fmt::print("\n{:<8}", "");
  for (std::size_t i = 0; i < variants.size(); ++i) {
    fmt::print("{:>26}", "median    p99  of floor");
  }
  fmt::print("\n");
  for (std::size_t size = 0; size < kSizes.size(); ++size) {
    fmt::print("{:<8}", kSizes[size] / 1024);
    const double floor = quantile(variants.front()->sizes[size].latencies, 0.5);
    for (const Variant* variant : variants) {
      const Nanoseconds& latencies = variant->sizes[size].latencies;
      const double middle = quantile(latencies, 0.5);
      fmt::print("{:>10.1f}{:>7.0f}{:>9.3f}", middle, quantile(latencies, 0.99), middle / floor);
    }
    fmt::print("\n");
  }
}

}  // namespace

int main() try {
  if (access(LATENCY_STACK_WITHOUT_TRACEPOINTS, X_OK) != 0) {
    latency::fail(LATENCY_STACK_WITHOUT_TRACEPOINTS
                  " is not built: build the target latency_stack_without_tracepoints, as ./dev bench does");
  }
  latency::TracingSession session;
  Variant bare{"bare, wait set", LATENCY_BARE, "wait_set", 60};
  Variant idle{"stack, tracing idle", LATENCY_STACK, "subscriber", 61};
  Variant disabled{"stack, no tracing", LATENCY_STACK, "subscriber", 62, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}};
  Variant without{"stack, no tracepoints", LATENCY_STACK_WITHOUT_TRACEPOINTS, "subscriber", 64};
  Variant listener{"bare, in listener", LATENCY_BARE, "listener", 63};
  const std::vector<Variant*> variants = {&bare, &idle, &disabled, &without, &listener};
  // For the processes of `idle` with the session started, and for those of `disabled` at the same time.
  std::vector<Samples> recorded(kSizes.size());
  std::vector<Samples> beside_recorded(kSizes.size());
  std::vector<double> loop_costs;
  std::vector<std::vector<double>> paced_costs(kSizes.size());
  latency::Worker tracepoints({LATENCY_TRACEPOINTS}, {}, 1);

  for (int generation = 0; generation < kGenerations; ++generation) {
    for (Variant* variant : variants) {
      variant->start();
    }
    for (Variant* variant : variants) {
      variant->pair->wait_ready();
      for (std::size_t size = 0; size < kSizes.size(); ++size) {
        variant->run(size, kWarmUpMessages);
      }
    }
    for (std::size_t round = 0; round < kRounds; ++round) {
      for (std::size_t size = 0; size < kSizes.size(); ++size) {
        for (std::size_t turn = 0; turn < variants.size(); ++turn) {
          Variant& variant = *variants[(turn + round) % variants.size()];
          variant.sizes[size].add(variant.run(size, kMessages));
        }
      }
      session.start();
      for (std::size_t size = 0; size < kSizes.size(); ++size) {
        beside_recorded[size].add(disabled.run(size, kMessages));
        recorded[size].add(idle.run(size, kMessages));
      }
      if (round == 0) {
        for (std::size_t size = 0; size < kSizes.size(); ++size) {
          const latency::PathCosts costs = cost_of_tracepoints_on_the_path(tracepoints, kSizes[size]);
          loop_costs.push_back(costs.in_a_loop);
          paced_costs[size].push_back(costs.at_pace);
        }
      }
      session.stop();
    }
  }

  fmt::print("latency in microseconds, {} messages each\n", kGenerations * kRounds * kMessages);
  print_table({&bare, &idle, &disabled, &without, &listener});

  fmt::print(
      "\nThe tracepoints on the path cost {:.2f} microseconds when each is called in a loop. They cost more when "
      "called "
      "at the\npace of the messages, each time after the copy of one, with nothing else between them:\n",
      median(loop_costs));
  fmt::print("{:<8}{:>16}{:>24}{:>26}{:>16}\n", "KiB", "at that pace", "added by idle ones", "added by recording all",
             "of that pace");
  for (std::size_t size = 0; size < kSizes.size(); ++size) {
    const double path = median(paced_costs[size]);
    const double by_recording = median(added(recorded[size], beside_recorded[size]));
    fmt::print("{:<8}{:>16.2f}{:>24.2f}{:>26.2f}{:>16.2f}\n", kSizes[size] / 1024, path,
               median(added(idle.sizes[size], without.sizes[size])), by_recording, by_recording / path);
  }

  for (std::size_t size = 0; size < kSizes.size(); ++size) {
    const std::string bytes = fmt::format("{} KiB, ", kSizes[size] / 1024);
    const std::vector<double> floor = by_generation(bare.sizes[size].batch_medians);
    for (const Variant* variant : {&idle, &disabled, &without, &listener}) {
      benchmarks::report(
          {bytes + variant->name, "us", by_generation(variant->sizes[size].batch_medians), bare.name, floor});
    }
    benchmarks::report(
        {bytes + "added by idle tracepoints", "us", by_generation(added(idle.sizes[size], without.sizes[size]))});
    benchmarks::report({bytes + "added by recording all events", "us",
                        by_generation(added(recorded[size], beside_recorded[size])),
                        "the tracepoints alone, at that pace", paced_costs[size]});
  }
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_latency: {}\n", error.what());
  return EXIT_FAILURE;
}
