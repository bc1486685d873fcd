// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/kept_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tracing::compare {
namespace {

TEST(KeptSamples, KeepsFewAsTheyAre) {
  KeptSamples samples;
  for (int i = 0; i < 200; ++i) {
    samples.add(1000 - i);
  }
  EXPECT_EQ(samples.count(), 200u);
  ASSERT_EQ(samples.values().size(), 200u);
  EXPECT_EQ(samples.values().front(), 1000);
  EXPECT_EQ(samples.values().back(), 801);
}

TEST(KeptSamples, KeepsManyEvenlyAndInOrder) {
  for (const int count : {255, 256, 257, 1000, 100'000, 1'234'567}) {
    KeptSamples samples;
    for (int i = 0; i < count; ++i) {
      samples.add(i);
    }
    const auto& values = samples.values();
    EXPECT_EQ(samples.count(), static_cast<std::uint64_t>(count));
    EXPECT_GE(values.size(), KeptSamples::kMost / 2 - 1);
    EXPECT_LT(values.size(), KeptSamples::kMost);
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
    std::int64_t gap = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      gap = std::max(gap, values[i] - values[i - 1]);
    }
    EXPECT_LT(gap, 4 * count / static_cast<int>(values.size())) << count;
  }
}

// Every second one of a regular sequence would give only one of both values.
TEST(KeptSamples, DoNotFallInStepWithWhatAlternates) {
  KeptSamples samples;
  for (int i = 0; i < 100'000; ++i) {
    samples.add(i % 2);
  }
  const auto ones = static_cast<double>(std::count(samples.values().begin(), samples.values().end(), 1));
  EXPECT_NEAR(ones / static_cast<double>(samples.values().size()), 0.5, 0.12);
}

}  // namespace
}  // namespace tracing::compare
