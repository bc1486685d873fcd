// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/duration_statistics.hpp"

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
  for (std::int64_t value = 100; value >= 1; --value) statistics.add(value);
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

TEST(DurationStatistics, EstimatesPercentilesOfManyValuesInBoundedMemory) {
  constexpr std::int64_t kMany = 1'000'000;
  DurationStatistics statistics;
  for (std::int64_t value = 1; value <= kMany; ++value) statistics.add(value);
  const DurationSummary summary = statistics.summary();
  EXPECT_EQ(summary.count, static_cast<std::uint64_t>(kMany));
  EXPECT_NEAR(summary.mean_ns, kMany / 2.0, 1);
  EXPECT_EQ(summary.min_ns, 1);
  EXPECT_EQ(summary.max_ns, kMany);
  EXPECT_NEAR(static_cast<double>(summary.p50_ns), kMany * 0.5, kMany * 0.01);
  EXPECT_NEAR(static_cast<double>(summary.p99_ns), kMany * 0.99, kMany * 0.002);
  EXPECT_FALSE(summary.percentiles_are_exact);
}

TEST(DurationStatistics, KeepsNegativeValues) {
  DurationStatistics statistics;
  for (const std::int64_t value : {-5, 5}) statistics.add(value);
  EXPECT_EQ(statistics.summary().min_ns, -5);
  EXPECT_EQ(statistics.summary().p50_ns, -5);
}

}  // namespace
}  // namespace tracing
