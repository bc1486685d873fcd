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
  EXPECT_EQ(way().median_ns, kMs);
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

}  // namespace
}  // namespace tracing::twin
