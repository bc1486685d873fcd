// SPDX-License-Identifier: Apache-2.0
// Comparisons of made-up runs. The random numbers have fixed seeds.
#include "tracing/model/compare/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "changed_subjects.hpp"
#include "made_up_runs.hpp"

namespace tracing::compare {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using ::testing::Not;

TEST(Comparison, FindsTwoMillisecondsInOneOfFiftyCallbacksEachTime) {
  for (std::uint64_t pair = 0; pair < 20; ++pair) {
    const int changed = static_cast<int>(pair * 7 % kCallbacks);
    const Comparison comparison =
        compared(run(2 * pair), run(2 * pair + 1, changed, [](int) { return 2 * kMillisecond; }));
    EXPECT_THAT(subjects(comparison), ElementsAre("/node_" + std::to_string(changed)));
    for (const Change& change : comparison.changes) {
      EXPECT_TRUE(change.is_slower());
      EXPECT_LE(change.probability, 0.01);
      if (change.statistic != Statistic::kMedian) {
        continue;
      }
      EXPECT_NEAR(change.shift.estimate, 2 * kMillisecond, 0.2 * kMillisecond);
      EXPECT_LT(change.shift.low, 2 * kMillisecond);
      EXPECT_GT(change.shift.high, 2 * kMillisecond);
    }
  }
}

TEST(Comparison, FindsNothingInRunsOfOneSystem) {
  int alarms = 0;
  for (std::uint64_t pair = 0; pair < 100; ++pair) {
    if (!compared(run(1000 + 2 * pair), run(1001 + 2 * pair)).changes.empty()) {
      ++alarms;
    }
  }
  EXPECT_LE(alarms, 2) << "of 100";
}

// For their whole length: timers have other phases, memory lies elsewhere.
RunSummary run_of_its_own(std::uint64_t seed, int changed = -1, double more = 0) {
  RunSummary summary = run(seed, changed, [more](int) { return more; });
  Random random(seed + 1'000'000);
  for (Measurement& one : summary.measurements) {
    const double shift = (random.uniform() < 0.3 ? 40 : 10) * kMicrosecond * random.normal();
    for (std::int64_t& sample : one.samples) {
      sample = std::max<std::int64_t>(sample + std::llround(shift), 1);
    }
  }
  return summary;
}

TEST(Comparison, WhatMostQuantitiesDifferInIsNoChange) {
  int alarms = 0;
  int found = 0;
  for (std::uint64_t pair = 0; pair < 20; ++pair) {
    const Comparison same = compared(run_of_its_own(8000 + 2 * pair), run_of_its_own(8001 + 2 * pair));
    if (!same.changes.empty()) {
      ++alarms;
    }
    const Comparison changed =
        compared(run_of_its_own(8000 + 2 * pair), run_of_its_own(8001 + 2 * pair, 30, 2 * kMillisecond));
    if (subjects(changed) == std::vector<std::string>{"/node_30"}) {
      ++found;
    }
  }
  EXPECT_LE(alarms, 1);
  EXPECT_GE(found, 19);
}

TEST(Comparison, ASlowerSystemIsToldAsAWhole) {
  RunSummary slower = run(9001, 20, [](int) { return 2 * kMillisecond; });
  for (Measurement& one : slower.measurements) {
    for (std::int64_t& sample : one.samples) {
      sample = sample * 14 / 10;
    }
  }
  const Comparison comparison = compared(run(9000), slower);
  EXPECT_THAT(subjects(comparison), ElementsAre("/node_20")) << "more than the others";
  ASSERT_TRUE(comparison.overall);
  EXPECT_EQ(comparison.overall->callbacks, 50u);
  EXPECT_EQ(comparison.overall->slower, 50u);
  EXPECT_NEAR(comparison.overall->ratio, 0.4, 0.05);
  EXPECT_FALSE(compared(run(9000), run(9001)).overall);
}

// For a while another program takes half of the processor.
TEST(Comparison, ADisturbanceOfARunIsNoChange) {
  RunSummary disturbed = run(2001);
  for (Measurement& one : disturbed.measurements) {
    for (std::size_t i = one.samples.size() / 2; i < one.samples.size() * 8 / 10; ++i) {
      one.samples[i] *= 2;
    }
  }
  EXPECT_THAT(compared(run(2000), disturbed).changes, IsEmpty());
}

TEST(Comparison, FindsWhatHappensOnlySometimes) {
  const Comparison comparison =
      compared(run(3000), run(3001, 10, [](int i) { return i % 5 == 0 ? 5 * kMillisecond : 0; }));
  ASSERT_EQ(comparison.changes.size(), 1u);
  EXPECT_EQ(comparison.changes[0].subject, "/node_10");
  EXPECT_EQ(comparison.changes[0].statistic, Statistic::kP90);
}

TEST(Comparison, SaysWhatBecameFaster) {
  const Comparison comparison = compared(run(4001, 49, [](int) { return 2 * kMillisecond; }), run(4000));
  ASSERT_THAT(subjects(comparison), ElementsAre("/node_49"));
  EXPECT_FALSE(comparison.changes[0].is_slower());
  EXPECT_NEAR(comparison.changes[0].shift.estimate, -2 * kMillisecond, 0.2 * kMillisecond);
}

TEST(Comparison, TheLeastChangeIsTheUsers) {
  const auto usual = [](int i) { return 10 * kMillisecond + i % 7 * kMicrosecond; };
  const auto longer = [&](int i) { return usual(i) + 300 * kMicrosecond; };
  RunSummary before;
  before.measurements = {measurement("/node", usual)};
  RunSummary after;
  after.measurements = {measurement("/node", longer)};
  EXPECT_THAT(compared(before, after).changes, IsEmpty()) << "less than 10 %";
  EXPECT_EQ(compared(before, after, {.least_ratio = 0.02}).changes.size(), 3u);
  EXPECT_THAT(compared(before, after, {.least_ratio = 0.02, .least_ns = 400'000}).changes, IsEmpty());
}

TEST(Comparison, AChangeHoldsAgainstEveryRunOfABaseline) {
  const auto add = [](double more) { return [more](int) { return more; }; };
  const Runs after{"after", {run(5003, 7, add(2 * kMillisecond))}};
  const Runs alike{"before", {run(5000), run(5001), run(5002)}};
  EXPECT_THAT(subjects(compare(alike, after, {})), ElementsAre("/node_7"));
  const Runs one_slow{"before", {run(5000), run(5001, 7, add(2 * kMillisecond)), run(5002)}};
  EXPECT_THAT(compare(one_slow, after, {}).changes, IsEmpty());
}

TEST(Comparison, NamesWhatOnlyOneSideHas) {
  RunSummary before = run(6000);
  RunSummary after = run(6001);
  before.measurements[3].subject = "/old";
  after.measurements[3].subject = "/new";
  const Comparison comparison = compared(before, after);
  EXPECT_THAT(comparison.gone, ElementsAre(Lone{Kind::kCallback, "/old"}));
  EXPECT_THAT(comparison.added, ElementsAre(Lone{Kind::kCallback, "/new"}));
  EXPECT_EQ(comparison.compared, 49u);
  // What not every run of a baseline has is not missed.
  EXPECT_THAT(compare({"", {before, run(6002)}}, {"", {after}}, {}).gone, IsEmpty());
}

TEST(Comparison, SaysWhatHasTooFewSamples) {
  const auto value = [](int i) { return 100 * kMicrosecond + i; };
  RunSummary before;
  before.measurements = {measurement("/rare", value, 15), measurement("/seldom", value, 50),
                         measurement("/often", value, 100)};
  const Comparison comparison = compared(before, before);
  EXPECT_EQ(comparison.compared, 3u);
  EXPECT_EQ(comparison.too_few_samples, 1u);
  EXPECT_EQ(comparison.tests, 5u) << "two for the seldom, three for the frequent";
}

TEST(Comparison, AChainNamesItsChangedCallbacks) {
  const auto add_chain = [](RunSummary& run, double more) {
    Measurement chain = measurement("a -> b", [&](int i) { return kMillisecond + i + more; });
    chain.kind = Kind::kChain;
    chain.quantity = "response";
    chain.steps = {"/node_1", "/node_2"};
    run.measurements.push_back(chain);
  };
  RunSummary before = run(7000);
  RunSummary after = run(7001, 2, [](int) { return 2 * kMillisecond; });
  add_chain(before, 0);
  add_chain(after, 2 * kMillisecond);
  after.measurements.back().doubtful = true;
  const Comparison comparison = compared(before, after);
  ASSERT_THAT(subjects(comparison), ElementsAre("/node_2", "a -> b"));
  EXPECT_THAT(comparison.changes.back().changed_steps, ElementsAre("/node_2"));
  EXPECT_TRUE(comparison.changes.back().doubtful);
  EXPECT_FALSE(comparison.changes.front().doubtful);
}

// Twenty callbacks on a machine that is busy with other programs. They take their processor away from a callback for
// some milliseconds, the more often the longer it runs, and for a while more than otherwise. In each run they prefer
// another callback, because it comes when the time of its thread is up.
RunSummary busy_run(std::uint64_t seed, int changed = -1, double more = 0) {
  constexpr int kBusyCallbacks = 20;
  Random random(seed);
  std::vector<double> load;  // of each part of the run, the same for all callbacks
  double level = 0;
  for (int i = 0; i < kSamples; ++i) {
    level = 0.95 * level + 0.3 * random.normal();
    load.push_back(0.2 * std::exp(level));
  }
  const int preferred = static_cast<int>(random.uniform() * kBusyCallbacks);
  RunSummary run;
  for (int number = 0; number < kBusyCallbacks; ++number) {
    const double work = 0.36 * kMillisecond + (number == changed ? more : 0);
    run.measurements.push_back(measurement("/node_" + std::to_string(number), [&](int i) {
      const double chance =
          load[static_cast<std::size_t>(i)] * (work / (0.36 * kMillisecond)) + (number == preferred ? 0.6 : 0);
      const double away = random.uniform() < chance ? kMillisecond * std::exp(1.5 + random.normal()) : 0;
      return work * (1 + 0.01 * random.normal()) + away;
    }));
  }
  return run;
}

TEST(Comparison, OnABusyMachineTheFastestRunsTellWhatHasChanged) {
  int alarms = 0;
  int by_time = 0;
  int by_part = 0;
  for (std::uint64_t pair = 0; pair < 40; ++pair) {
    const int changed = static_cast<int>(pair * 7 % 20);
    const std::vector<std::string> right{"/node_" + std::to_string(changed)};
    alarms += compared(busy_run(100 + 3 * pair), busy_run(101 + 3 * pair)).changes.empty() ? 0 : 1;
    by_time +=
        subjects(compared(busy_run(100 + 3 * pair), busy_run(102 + 3 * pair, changed, 2 * kMillisecond))) == right;
    by_part += subjects(compared(busy_run(100 + 3 * pair),
                                 busy_run(102 + 3 * pair, changed, 0.2 * 0.36 * kMillisecond))) == right;
  }
  EXPECT_LE(alarms, 1);
  EXPECT_GE(by_time, 39);
  EXPECT_GE(by_part, 36);
}

// More than the peers differ, but not by far.
TEST(Comparison, NamesWhatIsLikely) {
  const auto run_with = [](std::uint64_t seed, double ratio) {
    Random random(seed);
    RunSummary run;
    for (int number = 0; number < 21; ++number) {
      // One in four of them is 5 % or more slower or faster.
      const double own = 1 + 0.05 * (number % 4 - 1.5) * (seed % 2 == 0 ? 1 : -1);
      run.measurements.push_back(measurement("/node_" + std::to_string(number), [&](int) {
        return kMillisecond * own * (number == 20 ? ratio : 1) * (1 + 0.01 * random.normal());
      }));
    }
    return run;
  };
  const Comparison comparison = compared(run_with(100, 1), run_with(101, 1.9));
  EXPECT_THAT(comparison.changes, IsEmpty());
  ASSERT_THAT(comparison.likely, Not(IsEmpty()));
  EXPECT_EQ(comparison.likely[0].subject, "/node_20");
  EXPECT_THAT(compared(run_with(100, 1), run_with(103, 1)).likely, IsEmpty());
  EXPECT_THAT(compared(run_with(100, 1), run_with(103, 4)).changes, Not(IsEmpty()));
}

// A small system: a timer, a callback with two sorts of work, and one that takes `ratio` times a random duration, as in
// a twin whose durations are multiplied. The machine makes everything of a run longer by a part.
RunSummary small_run(std::uint64_t seed, double ratio = 1) {
  Random random(seed);
  const double machine = 1 + 0.1 * random.uniform();
  const auto spread = [&](double usual) { return machine * usual * std::exp(0.6 * random.normal()); };
  RunSummary run;
  run.measurements = {
      measurement("/ping, subscription /pong",
                  [&](int) { return (random.uniform() < 0.4 ? 2 : 53) * machine * kMicrosecond; }),
      measurement("/ping, timer 20 ms", [&](int) { return spread(200 * kMicrosecond); }),
      measurement("/pong, subscription /ping", [&](int) { return ratio * spread(200 * kMicrosecond); })};
  return run;
}

TEST(Comparison, OfFewCallbacksAMultipliedOneIsFound) {
  const std::vector<std::string> pong{"/pong, subscription /ping"};
  int alarms = 0;
  int three = 0;
  for (std::uint64_t pair = 0; pair < 40; ++pair) {
    const RunSummary before = small_run(2 * pair);
    EXPECT_EQ(subjects(compared(before, small_run(2 * pair + 1, 14))), pong) << pair;
    EXPECT_EQ(subjects(compared(small_run(2 * pair + 1, 14), before)), pong) << pair << ", the other way round";
    three += subjects(compared(before, small_run(2 * pair + 1, 3))) == pong;
    alarms += !compared(before, small_run(2 * pair + 1)).changes.empty();
  }
  EXPECT_GE(three, 38);
  EXPECT_EQ(alarms, 0);
  const Comparison comparison = compared(small_run(0), small_run(1, 14));
  EXPECT_TRUE(std::any_of(comparison.changes.begin(), comparison.changes.end(),
                          [](const Change& change) { return change.statistic == Statistic::kMedian; }));
}

// With six or more callbacks, the others tell what the machine delays. One that became much more scattered itself is
// not asked.
TEST(Comparison, AChangedCallbackIsNotAskedForTheDelay) {
  const auto run_with = [](std::uint64_t seed, double ratio) {
    Random random(seed);
    RunSummary run;
    for (int number = 0; number < 6; ++number) {
      run.measurements.push_back(measurement("/node_" + std::to_string(number), [&](int) {
        const double own = number >= 4 ? std::exp(1.5 * random.normal()) : 1 + 0.05 * random.normal();
        return (number == 5 ? ratio : 1) * own * kMillisecond;
      }));
    }
    return run;
  };
  EXPECT_THAT(subjects(compared(run_with(1, 1), run_with(2, 20))), ElementsAre("/node_5"));
  EXPECT_THAT(compared(run_with(1, 1), run_with(3, 1)).changes, IsEmpty());
}

TEST(Comparison, TheKernelTellsWhyACallbackTakesLonger) {
  const auto run_with = [](double running, double waiting, double blocked) {
    const auto part = [](const char* quantity, double value) {
      Measurement one = measurement("/node", [value](int i) { return value + i; });
      one.quantity = quantity;
      return one;
    };
    RunSummary run;
    run.measurements = {part("duration", running + waiting + blocked), part(kRunning, running), part(kWaiting, waiting),
                        part(kBlocked, blocked)};
    return run;
  };
  const RunSummary usual = run_with(kMillisecond, 0, 0);
  const auto cause = [](const RunSummary& before, const RunSummary& after) {
    const Comparison comparison = compared(before, after);
    return comparison.changes.empty() ? "no change" : comparison.changes[0].cause;
  };
  EXPECT_EQ(cause(usual, run_with(kMillisecond, 3 * kMillisecond, 0)),
            "more waiting for a processor, same running time");
  EXPECT_EQ(cause(usual, run_with(3 * kMillisecond, 0, 0)), "more running time");
  EXPECT_EQ(cause(usual, run_with(1.5 * kMillisecond, 0, 3 * kMillisecond)),
            "more sleeping or waiting for something else");
  EXPECT_EQ(cause(run_with(3 * kMillisecond, 0, 0), usual), "less running time");
  EXPECT_EQ(cause(run(1), run(2, 7, [](int) { return 2 * kMillisecond; })), "") << "without the kernel's events";
}

TEST(Comparison, IntervalsHaveNoTail) {
  RunSummary before;
  before.measurements = {measurement("/node", [](int i) { return 10 * kMillisecond + i; })};
  before.measurements[0].quantity = "interval";
  EXPECT_EQ(compared(before, before).tests, 1u);
}

}  // namespace
}  // namespace tracing::compare
