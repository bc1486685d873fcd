// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/contention.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/twin/small_system.hpp"
#include "tracing/model/twin/simulation.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;
using testing::SmallSystem;

// Each third message comes while another process has the processor, for 3 ms. What was recorded of the ways has that
// in it: 1 ms and 3 ms.
struct Contention : ::testing::Test {
  Contention() {
    const Index sender = small.add_timer("sender", 10 * kMs, kMs);
    const Index topic = small.publish(sender, "/a", 1);
    const Index other = small.add_timer("other", 30 * kMs, 3 * kMs, small.add_process("/other"));
    small.system.callbacks[other].phase_ns = kMs;
    small.system.executors[1].priority = 50;
    receiver = small.add_subscription("receiver", topic, 0, 0, small.add_process("/receiver"));
    Callback& callback = small.system.callbacks[receiver];
    callback.delays.values.assign(21, kMs);
    std::fill(callback.delays.values.begin() + 14, callback.delays.values.end(), 3 * kMs);
    callback.ways = callback.delays;
    small.system.active_ns = 4'000 * kMs;
  }

  FigureSummary way() const {
    Figures figures = Simulation(small.system).run(small.system.active_ns);
    return summary_of(figures[{FigureKind::kHop, hop_name("/one", "receiver")}]);
  }

  SmallSystem small;
  Index receiver = kNone;
};

TEST_F(Contention, WaitsThatWereRecordedAreNotSimulatedOnceMore) {
  EXPECT_EQ(way().median_ns, 3 * kMs);
  take_off_simulated_waits(small.system);
  EXPECT_NEAR(static_cast<double>(way().median_ns), kMs, 1000);
  EXPECT_EQ(way().p99_ns, 3 * kMs);
}

TEST_F(Contention, WhatHasNotWaitedStaysAsItWas) {
  small.system.cpus = 2;
  const std::vector<std::int64_t> recorded = small.system.callbacks[receiver].delays.values;
  take_off_simulated_waits(small.system);
  EXPECT_EQ(small.system.callbacks[receiver].delays.values, recorded);
}

// A run of 6 ms that was recorded without events of the kernel's scheduler was shorter by what it waited for.
TEST(RunsInContention, RunTimesAreShorterUnlessTheyAreProcessorTimes) {
  SmallSystem small;
  const Index one = small.add_timer("one", 20 * kMs, 0);
  small.system.callbacks[one].run_times.values = {4 * kMs, 6 * kMs};
  const Index urgent = small.add_timer("urgent", 40 * kMs, 2 * kMs, small.add_process("/two"));
  small.system.callbacks[urgent].phase_ns = kMs;
  small.system.executors[1].priority = 50;
  small.system.active_ns = 4'000 * kMs;
  const auto longest = [&] {
    System system = small.system;
    take_off_simulated_waits(system);
    return system.callbacks[one].run_times.values.back();
  };
  EXPECT_EQ(longest(), 6 * kMs);
  small.system.processor_times = false;
  EXPECT_LT(longest(), 6 * kMs);
}

// What was recorded of a stall of the whole machine holds up both ways at the same time, and no run more than it did.
TEST(StallInContention, IsWhereItWasRecorded) {
  SmallSystem small;
  small.system.cpus = 4;
  const Index sender = small.add_timer("sender", 10 * kMs, 0);
  const Index topic = small.publish(sender, "/a", 1);
  std::vector<Sample> samples;
  for (std::int64_t place = 0; place < 100; ++place) {
    const bool is_stalled = place >= 40 && place < 50;
    samples.push_back({place * 10 * kMs, is_stalled ? 8 * kMs : kMs});
  }
  small.system.active_ns = 999 * kMs;
  for (const char* name : {"one", "two"}) {
    const Index receiver = small.add_subscription(name, topic, 0, 0, small.add_process(std::string("/") + name));
    small.system.callbacks[receiver].delays = Distribution::of(samples);
    small.system.callbacks[receiver].ways = small.system.callbacks[receiver].delays;
  }
  take_off_simulated_waits(small.system);
  Figures figures = Simulation(small.system).run(small.system.active_ns);
  const std::vector<std::int64_t>& one = figures[{FigureKind::kHop, hop_name("/one", "one")}];
  EXPECT_EQ(one, (figures[{FigureKind::kHop, hop_name("/one", "two")}]));
  ASSERT_EQ(one.size(), 100u);
  for (std::size_t place = 0; place < one.size(); ++place) {
    EXPECT_EQ(one[place], (place >= 40 && place < 50 ? 8 : 1) * kMs) << place;
  }
}

// What was slow in the start is simulated, and neither counted nor made the reason to change what was recorded later.
TEST_F(Contention, FiguresCountFromTheTimeWhenTheSystemWasUp) {
  std::vector<Sample> samples;
  for (std::int64_t place = 0; place < 400; ++place) {
    samples.push_back({place * 10 * kMs, place < 50 ? 8 * kMs : kMs});
  }
  small.system.callbacks[receiver].delays = Distribution::of(samples);
  small.system.callbacks[receiver].ways = small.system.callbacks[receiver].delays;
  small.system.cpus = 4;
  EXPECT_EQ(way().count, 400u);
  EXPECT_EQ(way().p99_ns, 8 * kMs);
  small.system.up_ns = 500 * kMs;
  EXPECT_EQ(way().count, 350u);
  EXPECT_EQ(way().p99_ns, kMs);
  take_off_simulated_waits(small.system);
  EXPECT_EQ(small.system.callbacks[receiver].delays.values.back(), 8 * kMs);
  // A recording that is played twice has two starts; of a short part of it all counts.
  EXPECT_EQ(
      summary_of(Simulation(small.system).run(8'000 * kMs)[{FigureKind::kHop, hop_name("/one", "receiver")}]).count,
      700u);
  EXPECT_EQ(summary_of(Simulation(small.system).run(999 * kMs)[{FigureKind::kHop, hop_name("/one", "receiver")}]).count,
            100u);
}

// A timer of 10 ms publishes for a second; its messages arrived from the first to the last of these.
class LifetimeInSimulation : public ::testing::Test {
 protected:
  std::size_t arrived(std::int64_t first, std::int64_t last, std::int64_t delay_ns = 0) {
    SmallSystem small;
    const Index sender = small.add_timer("sender", 10 * kMs, 0);
    const Index topic = small.publish(sender, "/a", 1);
    const Index receiver = small.add_subscription("receiver", topic, 0, 0, small.add_process("/receiver"));
    std::vector<Sample> samples;
    for (std::int64_t place = first; place <= last; ++place) {
      samples.push_back({place * 10 * kMs + shift_ns_, delay_ns});
    }
    small.system.callbacks[receiver].delays = Distribution::of(samples);
    small.system.callbacks[receiver].ways = small.system.callbacks[receiver].delays;
    small.system.active_ns = 999 * kMs;
    Figures figures = Simulation(small.system).run(duration_ns_);
    return figures[{FigureKind::kHop, hop_name("/one", "receiver")}].size();
  }

  std::int64_t shift_ns_ = 0;
  std::int64_t duration_ns_ = 999 * kMs;
};

TEST_F(LifetimeInSimulation, WhatWasNotThereYetGetsNothing) {
  EXPECT_EQ(arrived(50, 99), 50u);
}

TEST_F(LifetimeInSimulation, WhatHadEndedGetsNothing) {
  EXPECT_EQ(arrived(0, 49), 50u);
  EXPECT_EQ(arrived(20, 49), 30u);
}

// Times in the simulation are not quite those of the recording: nothing is lost or added for that.
TEST_F(LifetimeInSimulation, SmallDifferencesAreNoEnd) {
  shift_ns_ = 4 * kMs;
  EXPECT_EQ(arrived(20, 49), 30u);
  shift_ns_ = -4 * kMs;
  EXPECT_EQ(arrived(20, 49), 30u);
}

TEST_F(LifetimeInSimulation, TheLastMessageArrivesThoughItTakesLong) {
  EXPECT_EQ(arrived(0, 99, 50 * kMs), 100u);
}

// As if the recording were played again: nothing says when what is longer ended.
TEST_F(LifetimeInSimulation, ALongerSimulationGoesOn) {
  duration_ns_ = 1499 * kMs;
  EXPECT_EQ(arrived(0, 49), 150u);
}

}  // namespace
}  // namespace tracing::twin
