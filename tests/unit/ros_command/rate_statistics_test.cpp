// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/calculations/rate_statistics.hpp"

#include <gtest/gtest.h>

using launch::bandwidth_table;
using launch::bandwidth_text;
using launch::BandwidthStatistics;
using launch::rate_table;

namespace {

TEST(Bandwidth, IsThatOfTheLastMessages) {
  BandwidthStatistics statistics(2);
  EXPECT_FALSE(statistics.summary(1.0));
  statistics.add(1.0, 5000);
  EXPECT_FALSE(statistics.summary(1.5));
  statistics.add(2.0, 100);
  statistics.add(3.0, 300);
  const auto summary = statistics.summary(4.0);
  ASSERT_TRUE(summary);
  EXPECT_EQ(bandwidth_text(*summary), "200 B/s from 2 messages\n\tMessage size mean: 200 B min: 100 B max: 300 B\n");
  EXPECT_FALSE(statistics.summary(2.0));
}

TEST(Bandwidth, IsNotTakenTwiceWithoutAMessage) {
  BandwidthStatistics statistics(10);
  statistics.add(1.0, 10);
  statistics.add(2.0, 10);
  EXPECT_TRUE(statistics.take_summary(3.0));
  EXPECT_FALSE(statistics.take_summary(4.0));
  statistics.add(4.5, 10);
  EXPECT_TRUE(statistics.take_summary(5.0));
}

TEST(Bandwidth, OfSeveralTopicsIsATable) {
  EXPECT_EQ(bandwidth_table({}), "");
  EXPECT_EQ(
      bandwidth_table({{"/chatter", {33.0, 24.0, 24.0, 24.0, 2}}, {"/points", {2.5e6, 1.25e6, 1.0e6, 1.5e6, 100}}}),
      " topic     bandwidth   window    mean       min       max  \n"
      "===========================================================\n"
      "/chatter   33 B/s      2        24 B      24 B      24 B   \n"
      "/points    2.50 MB/s   100      1.25 MB   1.00 MB   1.50 MB\n"
      "\n");
  EXPECT_EQ(rate_table({}), "");
}

}  // namespace
