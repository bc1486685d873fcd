// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/output_rules.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::SmallSystem;

// Which runs of the callbacks, one after the other, send something.
std::vector<bool> sent(OutputRules& rules, const std::vector<Index>& callbacks) {
  std::vector<bool> sent;
  for (const Index callback : callbacks) {
    sent.push_back(!rules.next_run(callback).outputs.empty());
  }
  return sent;
}

TEST(OutputRules, EverySecondRunSends) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 10, 1);
  small.publish(timer, "/a", 1);
  small.system.callbacks[timer].outputs[0].rule = Output::Rule::kEvery;
  small.system.callbacks[timer].outputs[0].every = 2;
  OutputRules rules(small.system);
  EXPECT_EQ(sent(rules, {0, 0, 0, 0}), (std::vector<bool>{false, true, false, true}));
}

TEST(OutputRules, AJoinSendsWhenAllInputsHaveCome) {
  SmallSystem small;
  small.add_timer("left", 10, 1);
  small.add_timer("right", 10, 1);
  small.publish(0, "/a", 1);
  small.system.callbacks[0].outputs[0].rule = Output::Rule::kJoin;
  small.system.callbacks[0].outputs[0].inputs = {0, 1};
  small.system.callbacks[1].outputs = small.system.callbacks[0].outputs;
  OutputRules rules(small.system);
  EXPECT_EQ(sent(rules, {0, 0, 1, 1, 0, 1, 0}), (std::vector<bool>{false, false, true, false, true, false, true}));
}

TEST(OutputRules, ChanceIsAsOftenAsItSays) {
  SmallSystem small;
  small.add_timer("timer", 10, 1);
  small.publish(0, "/a", 1);
  small.system.callbacks[0].outputs[0].rule = Output::Rule::kChance;
  small.system.callbacks[0].outputs[0].chance = 0.3;
  OutputRules rules(small.system);
  const std::vector<bool> runs = sent(rules, std::vector<Index>(1000, 0));
  EXPECT_NEAR(static_cast<double>(std::count(runs.begin(), runs.end(), true)), 300, 50);
}

TEST(OutputRules, SilentRunsHaveTimesOfTheirOwn) {
  SmallSystem small;
  small.add_timer("timer", 10, 100);
  small.publish(0, "/a", 1);
  small.system.callbacks[0].outputs[0].rule = Output::Rule::kEvery;
  small.system.callbacks[0].outputs[0].every = 2;
  small.system.callbacks[0].silent_run_times.values = {7};
  OutputRules rules(small.system);
  EXPECT_EQ(rules.next_run(0).time_ns, 7);
  EXPECT_EQ(rules.next_run(0).time_ns, 100);
}

}  // namespace
}  // namespace tracing::twin
