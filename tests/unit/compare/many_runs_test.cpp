// SPDX-License-Identifier: Apache-2.0
// Comparisons of many made-up runs on each side. Runs differ as those of an idle machine with two processors on one
// core do: callbacks that coincide with others are slower for a whole run. The random numbers have fixed seeds.
#include "tracing/model/compare/many_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "changed_subjects.hpp"
#include "tracing/model/compare/comparison.hpp"

namespace tracing::compare::many_runs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kCallbacks = 20;
constexpr int kSamples = 150;
constexpr double kUsual = 360e3;  // ns

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

// How much longer than usual a callback takes in a whole run: often by up to a tenth, seldom by more than half.
double slowness(std::mt19937_64& random) {
  const double kind = uniform(random);
  return kind < 0.01 ? 1.5 + uniform(random) / 2 : kind < 0.3 ? 1 + uniform(random) / 10 : 1;
}

// `change`: what the duration of callback `changed` is multiplied by.
RunSummary run(std::uint64_t seed, int changed = -1, double change = 1) {
  std::mt19937_64 random(seed);
  RunSummary run;
  for (int number = 0; number < kCallbacks; ++number) {
    const double usual = kUsual * slowness(random) * (number == changed ? change : 1);
    Measurement one{
        Kind::kCallback, "/node_" + std::to_string(number), "duration", {}, std::uint64_t{kSamples}, {}, false};
    for (int i = 0; i < kSamples; ++i) {
      const double late = uniform(random) < 0.1 ? uniform(random) : 0;
      one.samples.push_back(std::llround(usual * (1 + 0.02 * uniform(random) + late)));
    }
    run.measurements.push_back(std::move(one));
  }
  return run;
}

Runs side(const char* name, std::uint64_t seed, int runs, int changed = -1, double change = 1) {
  Runs side{name, {}};
  for (int number = 0; number < runs; ++number) {
    side.runs.push_back(run(1000 * seed + static_cast<std::uint64_t>(number), changed, change));
  }
  return side;
}

// How often the callback that takes this much longer is named, and no other one, in twenty comparisons.
int found(int runs, double change) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const int changed = static_cast<int>(seed * 7 % kCallbacks);
    const Comparison comparison =
        compare(side("before", 2 * seed, runs), side("after", 2 * seed + 1, runs, changed, change), {});
    found += subjects(comparison) == std::vector{"/node_" + std::to_string(changed)} ? 1 : 0;
  }
  return found;
}

TEST(ManyRuns, ShowAFifthMoreInOneCallback) {
  EXPECT_GE(found(4, 1.2), 18);
  EXPECT_GE(found(5, 1.2), 18);
}

TEST(ManyRuns, ShowAFifthLessInOneCallback) {
  EXPECT_GE(found(4, 1 / 1.2), 18);
}

TEST(ManyRuns, OfOneSystemShowNothing) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_THAT(subjects(compare(side("before", 2 * seed, 4), side("after", 2 * seed + 1, 4), {})), IsEmpty()) << seed;
  }
}

TEST(ManyRuns, OneOfThemMayBeUnlikeTheOthers) {
  Runs after = side("after", 3, 4);
  after.runs[2] = run(77, 5, 2);
  EXPECT_THAT(subjects(compare(side("before", 2, 4), after, {})), IsEmpty());
  after = side("after", 3, 4, 5, 2);
  after.runs[2] = run(77);
  EXPECT_THAT(subjects(compare(side("before", 2, 4), after, {})), ElementsAre("/node_5"));
}

// A slow run before makes the change look like the opposite in its pairs.
TEST(ManyRuns, TellTheDirectionOfMostPairs) {
  Runs before = side("before", 2, 4);
  before.runs[1] = run(78, 5, 1.25);
  const Comparison comparison = compare(before, side("after", 3, 4, 5, 1.2), {});
  ASSERT_THAT(subjects(comparison), ElementsAre("/node_5"));
  EXPECT_TRUE(comparison.changes.front().is_slower());
  EXPECT_NEAR(comparison.changes.front().shift_ns(), 0.2 * kUsual, 0.06 * kUsual);
  EXPECT_GT(comparison.changes.front().shift_low_ns(), -0.1 * kUsual);
}

TEST(ManyRuns, OfTheMachineAloneAreTakenForNoChange) {
  Runs after = side("after", 3, 4);
  for (RunSummary& one : after.runs) {
    for (Measurement& measurement : one.measurements) {
      for (std::int64_t& sample : measurement.samples) {
        sample = sample * 5 / 4;
      }
    }
  }
  EXPECT_THAT(subjects(compare(side("before", 2, 4), after, {})), IsEmpty());
}

}  // namespace
}  // namespace tracing::compare::many_runs
