// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/duration_statistics.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

TEST(DurationStatistics, OfNothingHasCountZero) {
  EXPECT_EQ(DurationStatistics().summary().count, 0u);
}

TEST(DurationStatistics, OfOneValueIsThatValue) {
  DurationStatistics statistics;
  statistics.add(42);
  const DurationSummary summary = statistics.summary();
  EXPECT_EQ(summary.count, 1u);
  EXPECT_DOUBLE_EQ(summary.mean_ns, 42);
  EXPECT_DOUBLE_EQ(summary.stddev_ns, 0);
  EXPECT_EQ(summary.min_ns, 42);
  EXPECT_EQ(summary.p50_ns, 42);
  EXPECT_EQ(summary.p99_ns, 42);
  EXPECT_EQ(summary.max_ns, 42);
}

TEST(DurationStatistics, UsesNearestRankAndTheSampleDeviation) {
  DurationStatistics statistics;
  for (std::int64_t value = 100; value >= 1; --value) {
    statistics.add(value);
  }
  const DurationSummary summary = statistics.summary();
  EXPECT_DOUBLE_EQ(summary.mean_ns, 50.5);
  EXPECT_NEAR(summary.stddev_ns, 29.011491975882016, 1e-9);
  EXPECT_EQ(summary.min_ns, 1);
  EXPECT_EQ(summary.p50_ns, 50);
  EXPECT_EQ(summary.p90_ns, 90);
  EXPECT_EQ(summary.p99_ns, 99);
  EXPECT_EQ(summary.max_ns, 100);
  EXPECT_TRUE(summary.percentiles_are_exact);
}

TEST(DurationStatistics, KnowsPercentilesOfManyValuesToTwoThousandthsInBoundedMemory) {
  constexpr std::int64_t kMany = 1'000'000;
  DurationStatistics statistics;
  for (std::int64_t value = 1; value <= kMany; ++value) {
    statistics.add(value);
  }
  const DurationSummary summary = statistics.summary();
  EXPECT_EQ(summary.count, static_cast<std::uint64_t>(kMany));
  EXPECT_NEAR(summary.mean_ns, kMany / 2.0, 1);
  EXPECT_EQ(summary.min_ns, 1);
  EXPECT_EQ(summary.max_ns, kMany);
  const auto near = [](std::int64_t value, double expected) {
    EXPECT_NEAR(static_cast<double>(value), expected, expected * 0.002) << expected;
  };
  near(summary.p50_ns, 500'000);
  near(summary.p90_ns, 900'000);
  near(summary.p99_ns, 990'000);
  near(summary.p999_ns, 999'000);
  near(summary.p9999_ns, 999'900);
  EXPECT_FALSE(summary.percentiles_are_exact);
}

TEST(DurationStatistics, KnowsRareValuesOfManyOrdersOfMagnitude) {
  DurationStatistics statistics;
  for (int i = 0; i < 99'980; ++i) {
    statistics.add(3);
  }
  for (int i = 0; i < 19; ++i) {
    statistics.add(7'000'000'000);
  }
  statistics.add(9'000'000'000'000'000'000);
  const DurationSummary summary = statistics.summary();
  EXPECT_EQ(summary.p999_ns, 3);
  EXPECT_NEAR(static_cast<double>(summary.p9999_ns), 7e9, 7e9 * 0.002);
  EXPECT_EQ(summary.max_ns, 9'000'000'000'000'000'000);
}

TEST(DurationStatistics, KnowsTheSmallDeviationOfManyLargeValues) {
  DurationStatistics statistics;
  constexpr std::int64_t kLarge = 3'600'000'000'000'000;  // a thousand hours
  for (int i = 0; i < 100'000; ++i) {
    statistics.add(kLarge + (i % 2 == 0 ? 3 : -4));
  }
  const DurationSummary summary = statistics.summary();
  EXPECT_DOUBLE_EQ(summary.mean_ns, static_cast<double>(kLarge) - 0.5);
  EXPECT_NEAR(summary.stddev_ns, 3.5, 1e-4);
  EXPECT_EQ(summary.min_ns, kLarge - 4);
}

TEST(DurationStatistics, OfTwoSamplesAreThoseOfAllValues) {
  for (const int count : {10, 10'000}) {
    DurationStatistics all;
    DurationStatistics odd;
    DurationStatistics together;
    for (std::int64_t value = 1; value <= count; ++value) {
      all.add(value);
      (value % 2 == 1 ? odd : together).add(value);
    }
    together.add(odd);
    const DurationSummary expected = all.summary();
    const DurationSummary summary = together.summary();
    EXPECT_EQ(summary.count, expected.count);
    EXPECT_DOUBLE_EQ(summary.mean_ns, expected.mean_ns);
    EXPECT_NEAR(summary.stddev_ns, expected.stddev_ns, expected.stddev_ns * 1e-9);
    EXPECT_EQ(summary.min_ns, expected.min_ns);
    EXPECT_EQ(summary.p90_ns, expected.p90_ns);
    EXPECT_EQ(summary.max_ns, expected.max_ns);
  }
}

TEST(DurationStatistics, KeepsNegativeValues) {
  DurationStatistics statistics;
  for (const std::int64_t value : {-5, 5}) {
    statistics.add(value);
  }
  EXPECT_EQ(statistics.summary().min_ns, -5);
  EXPECT_EQ(statistics.summary().p50_ns, -5);
}

}  // namespace
}  // namespace tracing
