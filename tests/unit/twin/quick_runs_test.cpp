// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/quick_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/twin/small_system.hpp"
#include "tracing/model/twin/description/output_rules.hpp"

namespace tracing::twin {
namespace {

using testing::SmallSystem;

// A timer that always sends, two inputs of a join, one that sends by chance, and one that sends nothing.
struct Rules : SmallSystem {
  Rules() {
    for (const char* name : {"always", "left", "right", "chance", "silent"}) {
      add_timer(name, 10, 1);
    }
    publish(0, "/a", 1);
    publish(1, "/b", 1);
    system.callbacks[1].outputs[0].rule = Output::Rule::kJoin;
    system.callbacks[1].outputs[0].inputs = {1, 2};
    system.callbacks[2].outputs = system.callbacks[1].outputs;
    publish(3, "/c", 1);
    system.callbacks[3].outputs[0].rule = Output::Rule::kChance;
    system.callbacks[3].outputs[0].chance = 0.5;
  }
};

TEST(QuickRuns, SendAsTheRulesDo) {
  const Rules rules;
  OutputRules slow(rules.system);
  QuickRuns quick(rules.system);
  for (const Index callback : {0, 1, 1, 2, 2, 4, 1, 0, 2, 1}) {
    ASSERT_TRUE(quick.knows(callback));
    const QuickRuns::Run run = quick.next(callback);
    EXPECT_EQ(run.outputs != nullptr ? *run.outputs : std::vector<std::size_t>(), slow.next_run(callback).outputs);
  }
  EXPECT_FALSE(quick.knows(3));
}

TEST(QuickRuns, LeaveAJoinWithAnotherRuleToTheRules) {
  Rules rules;
  rules.system.callbacks[2].outputs.push_back(rules.system.callbacks[3].outputs[0]);
  const QuickRuns quick(rules.system);
  EXPECT_FALSE(quick.knows(1));
  EXPECT_FALSE(quick.knows(2));
}

TEST(QuickRuns, HaveEachTimeOnceBeforeTheyHaveItAgain) {
  Rules rules;
  rules.system.callbacks[4].run_times = Distribution::of(std::vector<std::int64_t>{1, 2, 3, 4});
  QuickRuns quick(rules.system);
  for (int round = 0; round < 10; ++round) {
    std::vector<std::int64_t> times;
    for (int run = 0; run < 4; ++run) {
      times.push_back(quick.next(4).time_ns);
    }
    std::sort(times.begin(), times.end());
    EXPECT_EQ(times, (std::vector<std::int64_t>{1, 2, 3, 4}));
  }
}

}  // namespace
}  // namespace tracing::twin
