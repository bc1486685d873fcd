// How long a message takes from publish() to the callback of a subscription in another process, through the stack and
// through bare Fast DDS, and what recording every ros2 event adds to it.
//
// All variants run in one process pair each and take turns, batch by batch, so that whatever the machine does meanwhile
// meets them all. Latencies are differences of CLOCK_MONOTONIC, taken just before publish() and first in the callback.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "latency_run.hpp"
#include "tracing_session.hpp"

namespace {

using latency::Batch;
using latency::kSizes;
using Nanoseconds = std::vector<std::int64_t>;

constexpr int kRounds = 48;
constexpr int kRoundsPerCost = 6;
constexpr std::uint64_t kMessages = 60;        // of a batch
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

// What one size did in one variant.
struct Samples {
  Nanoseconds latencies;
  std::vector<double> batch_medians;  // microseconds, one per round

  void add(const Nanoseconds& batch) {
    latencies.insert(latencies.end(), batch.begin(), batch.end());
    batch_medians.push_back(quantile(batch, 0.5));
  }
};

struct Variant {
  Variant(std::string variant_name, const std::string& program, const std::string& role, int domain,
          std::map<std::string, std::string> environment = {})
      : name(std::move(variant_name)), pair([&] {
          environment["ROS_DOMAIN_ID"] = std::to_string(domain);
          return latency::Pair(program, role, environment);
        }()) {}

  std::string name;
  latency::Pair pair;
  std::vector<Samples> sizes = std::vector<Samples>(kSizes.size());
};

// The median over the rounds of how much longer `variant` took than `floor`, in microseconds: neighbours in time are
// compared, so slow drifts of the machine cancel out.
double added(const Samples& variant, const Samples& floor) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < floor.batch_medians.size(); ++i) {
    differences.push_back(variant.batch_medians[i] - floor.batch_medians[i]);
  }
  return median(differences);
}

// Asks a process that is traced as the stack is: the sum of what the events between the two clock readings cost, each
// from a loop of its own, in microseconds.
double cost_of_tracepoints_on_the_path(latency::Worker& tracepoints) {
  double cost = 0;
  tracepoints.send("?", 1);
  tracepoints.receive(&cost, sizeof cost);
  return cost;
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
  latency::TracingSession session;
  constexpr int kFirstDomain = 60;
  Variant listener("bare, in listener", LATENCY_BARE, "listener", kFirstDomain);
  Variant bare("bare, wait set", LATENCY_BARE, "wait_set", kFirstDomain + 1);
  Variant disabled("stack, no tracing", LATENCY_STACK, "subscriber", kFirstDomain + 2,
                   {{"TRACETOOLS_RUNTIME_DISABLE", "1"}});
  Variant idle("stack, tracing idle", LATENCY_STACK, "subscriber", kFirstDomain + 3);
  // The same processes as `idle`, with the session started.
  std::vector<Samples> recorded(kSizes.size());
  latency::Worker tracepoints({LATENCY_TRACEPOINTS}, {});

  const std::vector<Variant*> variants = {&bare, &idle, &disabled, &listener};
  for (Variant* variant : variants) {
    variant->pair.wait_ready();
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
      variant->pair.run({size, kWarmUpMessages, kPeriod});
    }
  }
  std::vector<double> path_costs;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
      for (std::size_t turn = 0; turn < variants.size(); ++turn) {
        Variant& variant = *variants[(turn + static_cast<std::size_t>(round)) % variants.size()];
        variant.sizes[size].add(variant.pair.run({size, kMessages, kPeriod}));
      }
    }
    session.start();
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
      recorded[size].add(idle.pair.run({size, kMessages, kPeriod}));
    }
    if (round % kRoundsPerCost == 0) {
      path_costs.push_back(cost_of_tracepoints_on_the_path(tracepoints));
    }
    session.stop();
  }

  fmt::print("latency in microseconds, {} messages each\n", kRounds * kMessages);
  print_table({&bare, &idle, &disabled, &listener});

  const double path = median(path_costs);
  fmt::print("\nThe tracepoints on the path cost {:.2f} microseconds when each is called in a loop; added to the latency by:\n{:<8}{:>20}{:>26}{:>14}\n",
             path, "KiB", "tracing idle", "every event recorded", "of the loop");
  for (std::size_t size = 0; size < kSizes.size(); ++size) {
    const double by_recording = added(recorded[size], idle.sizes[size]);
    fmt::print("{:<8}{:>20.2f}{:>26.2f}{:>14.2f}\n", kSizes[size] / 1024, added(idle.sizes[size], disabled.sizes[size]),
               by_recording, by_recording / path);
  }
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_latency: {}\n", error.what());
  return EXIT_FAILURE;
}
