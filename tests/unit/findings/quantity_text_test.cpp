// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/quantity_text.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

TEST(FormatDuration, HasThreeDigitsAndAUnit) {
  EXPECT_EQ(format_duration(0), "0 ns");
  EXPECT_EQ(format_duration(999), "999 ns");
  EXPECT_EQ(format_duration(1.5), "1.50 ns");
  EXPECT_EQ(format_duration(999.7), "1.00 us");
  EXPECT_EQ(format_duration(1000), "1.00 us");
  EXPECT_EQ(format_duration(9'999), "10.0 us");
  EXPECT_EQ(format_duration(45'678), "45.7 us");
  EXPECT_EQ(format_duration(99'960), "100 us");
  EXPECT_EQ(format_duration(500'000'000), "500 ms");
  EXPECT_EQ(format_duration(107'800'000'000), "108 s");
  EXPECT_EQ(format_duration(1'234'000'000'000), "1234 s");
  EXPECT_EQ(format_duration(-1500), "-1.50 us");
}

TEST(FormatTime, IsUtcWithMicroseconds) {
  EXPECT_EQ(format_time(1'767'225'600'123'456'789), "2026-01-01 00:00:00.123456 UTC");
  EXPECT_EQ(format_time(-1), "1969-12-31 23:59:59.999999 UTC");
}

TEST(FormatCount, KnowsThePlural) {
  EXPECT_EQ(format_count(1, "event"), "1 event");
  EXPECT_EQ(format_count(0, "event"), "0 events");
  EXPECT_EQ(format_count(2, "process"), "2 processes");
}

}  // namespace
}  // namespace tracing
