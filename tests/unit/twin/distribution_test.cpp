// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tracing::twin {
namespace {

TEST(Distribution, KeepsFewValuesAsTheyAre) {
  EXPECT_EQ(Distribution::of({3, 1, 2}).values, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(Distribution::of({3, 1, 2}).quantile(0.5), 2);
  EXPECT_EQ(Distribution::of({}).quantile(0.5), 0);
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
  const Distribution distribution = Distribution::of({1, 2, 3, 4, 5, 6, 7, 8});
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

}  // namespace
}  // namespace tracing::twin
