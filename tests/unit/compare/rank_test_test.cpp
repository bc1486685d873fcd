// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/rank_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace tracing::compare {
namespace {

// The probability by counting all orders of the values.
double counted_probability(std::size_t before, std::size_t after, double least_u) {
  std::vector<int> is_after(before + after, 0);
  std::fill(is_after.end() - static_cast<std::ptrdiff_t>(after), is_after.end(), 1);
  double as_high = 0;
  double all = 0;
  do {
    double u = 0;
    double lower = 0;
    for (const int one : is_after) {
      if (one == 1) {
        u += lower;
      }
      if (one == 0) {
        ++lower;
      }
    }
    ++all;
    if (u >= least_u) {
      ++as_high;
    }
  } while (std::next_permutation(is_after.begin(), is_after.end()));
  return as_high / all;
}

// Two samples with exactly `u` pairs in which the value after is higher.
std::pair<std::vector<double>, std::vector<double>> samples_with(std::size_t before, std::size_t after, std::size_t u) {
  std::vector<double> earlier(before);
  std::iota(earlier.begin(), earlier.end(), 1);
  std::vector<double> later;
  for (std::size_t i = 0; i < after; ++i) {
    const std::size_t higher_than = std::min(before, u);
    u -= higher_than;
    later.push_back(static_cast<double>(higher_than) + 0.5);
  }
  return {earlier, later};
}

TEST(RankProbability, IsThatOfAllOrders) {
  for (const auto& [before, after] : {std::pair<std::size_t, std::size_t>{1, 1}, {1, 7}, {3, 3}, {4, 5}, {6, 4}}) {
    for (std::size_t u = 0; u <= before * after; ++u) {
      const auto [earlier, later] = samples_with(before, after, u);
      EXPECT_NEAR(rank_probability(earlier, later), counted_probability(before, after, static_cast<double>(u)), 1e-12)
          << before << " " << after << " " << u;
    }
  }
}

TEST(RankProbability, KeepsItsDigitsForManyValues) {
  std::vector<double> low(50);
  std::iota(low.begin(), low.end(), 0);
  std::vector<double> high(50);
  std::iota(high.begin(), high.end(), 100);
  // One of the "100 over 50" orders.
  EXPECT_NEAR(rank_probability(low, high) * 1.0089134454556e29, 1, 1e-6);
  EXPECT_EQ(rank_probability(high, low), 1);
}

TEST(RankProbability, CountsEqualValuesHalf) {
  EXPECT_NEAR(rank_probability({5, 5}, {5, 5}), counted_probability(2, 2, 2), 1e-12);
}

TEST(SignProbability, IsThatOfCoins) {
  EXPECT_NEAR(sign_probability(10, 10), 2.0 / 1024, 1e-12);
  EXPECT_NEAR(sign_probability(9, 10), 2 * 11.0 / 1024, 1e-12);
  EXPECT_EQ(sign_probability(5, 10), 1);
}

TEST(Shift, IsTheMedianOfDifferences) {
  const Shift shift = shift_between({1, 2, 3}, {11, 12, 16}, 0.9);
  EXPECT_EQ(shift.estimate, 10);
  EXPECT_EQ(shift.low, 8) << "three values can give no shorter interval than the whole";
  EXPECT_EQ(shift.high, 15);
}

// The tables of the test have 23 as critical value for two samples of ten at 5 %.
TEST(Shift, HasTheIntervalOfTheTest) {
  std::vector<double> before(10);
  std::iota(before.begin(), before.end(), 0);
  std::vector<double> after;
  for (const double value : before) {
    after.push_back(100 + value * 17);
  }
  std::vector<double> differences;
  for (const double a : after) {
    for (const double b : before) {
      differences.push_back(a - b);
    }
  }
  std::sort(differences.begin(), differences.end());
  const Shift shift = shift_between(before, after, 0.95);
  EXPECT_EQ(shift.low, differences[23]);
  EXPECT_EQ(shift.high, differences[99 - 23]);
}

TEST(CorrectedForMany, IsHolmsMethod) {
  const std::vector<double> corrected = corrected_for_many({0.01, 0.04, 0.03, 0.005});
  ASSERT_EQ(corrected.size(), 4u);
  EXPECT_NEAR(corrected[0], 0.03, 1e-12);
  EXPECT_NEAR(corrected[1], 0.06, 1e-12);
  EXPECT_NEAR(corrected[2], 0.06, 1e-12);
  EXPECT_NEAR(corrected[3], 0.02, 1e-12);
  EXPECT_TRUE(corrected_for_many({}).empty());
}

TEST(Quantile, IsANearestRank) {
  std::vector<double> values{5, 1, 4, 2, 3, 10, 9, 8, 7, 6};
  EXPECT_EQ(quantile(values, 0.5), 5);
  EXPECT_EQ(quantile(values, 0.9), 9);
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 1), 10);
}

TEST(RankAutocorrelation, TellsDriftFromNoise) {
  std::vector<double> drift(20);
  std::iota(drift.begin(), drift.end(), 0);
  EXPECT_GT(rank_autocorrelation(drift), 0.8);
  std::vector<double> alternating(20);
  for (std::size_t i = 0; i < 20; ++i) {
    alternating[i] = static_cast<double>(i % 2);
  }
  EXPECT_LT(rank_autocorrelation(alternating), -0.8);
  EXPECT_EQ(rank_autocorrelation(std::vector<double>(20, 3.0)), 0);
}

}  // namespace
}  // namespace tracing::compare
