// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tracing::twin {
namespace {

TEST(Distribution, KeepsFewValuesAsTheyAre) {
  EXPECT_EQ(Distribution::of(std::vector<std::int64_t>{3, 1, 2}).values, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(Distribution::of(std::vector<std::int64_t>{3, 1, 2}).quantile(0.5), 2);
  EXPECT_EQ(Distribution::of(std::vector<std::int64_t>{}).quantile(0.5), 0);
}

TEST(Distribution, KeepsTheEndsAndTheQuantilesOfManyValues) {
  std::vector<std::int64_t> values;
  for (std::int64_t value = 10'000; value > 0; --value) {
    values.push_back(value);
  }
  const Distribution distribution = Distribution::of(values);
  EXPECT_EQ(distribution.values.size(), Distribution::kMost);
  EXPECT_EQ(distribution.values.front(), 1);
  EXPECT_EQ(distribution.values.back(), 10'000);
  EXPECT_NEAR(static_cast<double>(distribution.quantile(0.5)), 5'000, 25);
  EXPECT_NEAR(static_cast<double>(distribution.quantile(0.99)), 9'900, 25);
}

TEST(Draw, GivesEachValueOnceAndThenAgain) {
  const Distribution distribution = Distribution::of(std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8});
  Draw draw(distribution, 1);
  for (int round = 0; round < 2; ++round) {
    std::vector<std::int64_t> values;
    for (int count = 0; count < 8; ++count) {
      values.push_back(draw.next());
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(values, distribution.values);
  }
}

TEST(Distribution, KnowsWhenEachValueWasRecorded) {
  const Distribution distribution = Distribution::of(std::vector<Sample>{{30, 5}, {10, 9}, {20, 7}});
  EXPECT_EQ(distribution.values, (std::vector<std::int64_t>{5, 7, 9}));
  ASSERT_EQ(distribution.moments.size(), 3u);
  EXPECT_EQ(distribution.moments[0].time_ns, 10);
  EXPECT_EQ(distribution.moments[0].place, 2u);
  EXPECT_EQ(distribution.moments[2].place, 0u);
}

TEST(Draw, GivesWhatWasRecordedThenCycleAfterCycle) {
  const Distribution distribution = Distribution::of(std::vector<Sample>{{110, 5}, {120, 9}, {130, 7}, {140, 8}});
  Draw draw(distribution, 1, {100, 50});
  for (const std::int64_t round : {0, 50, 100}) {
    std::vector<std::int64_t> values;
    for (const std::int64_t time : {11, 19, 34, 38}) {
      values.push_back(draw.next_at(round + time).value);
    }
    EXPECT_EQ(values, (std::vector<std::int64_t>{5, 9, 7, 8}));
  }
  EXPECT_EQ(draw.next_at(31).value, 7);
}

TEST(Draw, TakesAnyWhereNothingWasRecordedNear) {
  const Distribution distribution = Distribution::of(std::vector<Sample>{{901, 1}, {902, 2}, {903, 3}});
  Draw draw(distribution, 1, {0, 1000});
  std::vector<std::int64_t> values;
  for (const std::int64_t time : {100, 200, 300}) {
    values.push_back(draw.next_at(time).value);
  }
  std::sort(values.begin(), values.end());
  EXPECT_EQ(values, (std::vector<std::int64_t>{1, 2, 3}));
}

}  // namespace
}  // namespace tracing::twin
