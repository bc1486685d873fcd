// SPDX-License-Identifier: Apache-2.0
// Comparisons of made-up runs. The random numbers have fixed seeds.
#include "tracing/model/compare/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace tracing::compare {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kCallbacks = 50;
constexpr int kSamples = 250;
constexpr double kMicrosecond = 1e3;
constexpr double kMillisecond = 1e6;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double normal() {  // nearly: the sum of twelve uniform numbers
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      sum += uniform();
    }
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

Measurement measurement(const std::string& subject, const std::function<double(int)>& value, int samples = kSamples) {
  Measurement one{Kind::kCallback, subject, "duration", {}, static_cast<std::uint64_t>(samples), {}, false};
  for (int i = 0; i < samples; ++i) {
    one.samples.push_back(std::llround(std::max(value(i), 1.0)));
  }
  return one;
}

// Durations of 50 us to 1 ms that resemble their neighbours, with outliers. `changed` gets what `change` adds.
RunSummary run(std::uint64_t seed, int changed = -1, const std::function<double(int)>& change = {}) {
  Random random(seed);
  RunSummary run;
  for (int number = 0; number < kCallbacks; ++number) {
    const double usual = (50 + 19 * number) * kMicrosecond;
    double slow = 0;
    run.measurements.push_back(measurement("/node_" + std::to_string(number), [&](int i) {
      slow = 0.9 * slow + 0.1 * random.normal();
      const double outlier = random.uniform() < 0.03 ? 3 * kMillisecond * random.uniform() : 0;
      return usual * (1 + 0.2 * slow + 0.02 * random.normal()) + outlier + (number == changed ? change(i) : 0);
    }));
  }
  return run;
}

Comparison compared(RunSummary before, RunSummary after, const CompareOptions& options = {}) {
  return compare({"before", {std::move(before)}}, {"after", {std::move(after)}}, options);
}

std::vector<std::string> subjects(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Change& change : comparison.changes) {
    if (names.empty() || names.back() != change.subject) {
      names.push_back(change.subject);
    }
  }
  return names;
}

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
  EXPECT_EQ(compared(before, after, {.least_ratio = 0.02}).changes.size(), 2u);
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
  before.measurements = {measurement("/rare", value, 49), measurement("/seldom", value, 50),
                         measurement("/often", value, 100)};
  const Comparison comparison = compared(before, before);
  EXPECT_EQ(comparison.compared, 3u);
  EXPECT_EQ(comparison.too_few_samples, 1u);
  EXPECT_EQ(comparison.tests, 3u) << "one for the seldom, two for the frequent";
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

TEST(Comparison, IntervalsHaveNoTail) {
  RunSummary before;
  before.measurements = {measurement("/node", [](int i) { return 10 * kMillisecond + i; })};
  before.measurements[0].quantity = "interval";
  EXPECT_EQ(compared(before, before).tests, 1u);
}

}  // namespace
}  // namespace tracing::compare
