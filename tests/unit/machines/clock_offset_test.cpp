// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace {

using launch::ClockOffset;
using launch::ClockReading;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kBegin = 5000 * kSecond;  // of the monotonic clock
constexpr std::int64_t kEpoch = 1'700'000'000 * kSecond;

ClockReading at(std::int64_t monotonic, std::int64_t epoch = kEpoch) {
  return {.epoch_ns = epoch + monotonic, .monotonic_ns = monotonic};
}

// The error of the estimate at a moment.
std::int64_t error(const ClockOffset::Measured& measured, std::int64_t moment, std::int64_t truth) {
  return std::abs(measured.offset_ns +
                  static_cast<std::int64_t>(measured.drift * static_cast<double>(moment - measured.at_ns)) - truth);
}

// Each direction takes 100 to 400 us, and every tenth round trip meets a busy machine. The clock is off, and drifts.
TEST(ClockOffset, TheTruthIsWithinTheBounds) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> way(100'000, 400'000);
  std::uniform_int_distribution<std::int64_t> load(0, 50'000'000);
  for (int run = 0; run < 100; ++run) {
    const std::int64_t offset = 3'700'000'000 - run * 71'000'000LL;
    const double drift = 50e-6;
    ClockOffset clock;
    const auto truth = [&](std::int64_t moment) {
      return offset + static_cast<std::int64_t>(drift * static_cast<double>(moment - kBegin));
    };
    std::int64_t last = 0;
    for (int i = 0; i < 600; ++i) {
      const std::int64_t sent = kBegin + i * kSecond / 10;
      const std::int64_t there = sent + way(random) + (i % 10 == 3 ? load(random) : 0);
      last = there + way(random);
      clock.add(last - sent, at(last), at(there + truth(there)));
    }
    const auto measured = clock.measured();
    ASSERT_TRUE(measured);
    EXPECT_EQ(measured->round_trips, 600U);
    EXPECT_NEAR(measured->drift, drift, 10e-6);
    EXPECT_LT(measured->uncertainty_ns, 400'000);
    for (std::int64_t moment = kBegin + kSecond; moment < last - kSecond; moment += kSecond) {
      EXPECT_LE(error(*measured, moment, truth(moment)), measured->uncertainty_ns) << "run " << run;
    }
  }
}

TEST(ClockOffset, ClocksThatAgreeHaveNoDrift) {
  ClockOffset clock;
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t now = kBegin + i * kSecond;
    clock.add(200'000, at(now), at(now - 100'000 + 30'000 + i % 7 * 1000));
  }
  EXPECT_EQ(clock.measured()->drift, 0);
  EXPECT_NEAR(static_cast<double>(clock.measured()->offset_ns), 33'000, 4000);
}

// As when another clock is taken for the measure meanwhile.
TEST(ClockOffset, AClockThatJumpsMakesTheResultUncertain) {
  ClockOffset clock;
  for (std::int64_t i = 0; i < 60; ++i) {
    const std::int64_t now = kBegin + i * kSecond;
    clock.add(200'000, at(now), at(now - 100'000 + (i < 30 ? 0 : 5'000'000)));
  }
  EXPECT_GE(clock.measured()->uncertainty_ns, 5'000'000);
}

TEST(ClockOffset, TheShortestRoundTripCounts) {
  ClockOffset clock;
  EXPECT_FALSE(clock.measured());
  clock.add(50'000'000, at(kBegin + 50'000'000), at(kBegin + 1000 + 49'000'000));
  clock.add(200'000, at(kBegin + 60'000'000), at(kBegin + 59'900'000 + 1000));
  const auto measured = clock.measured();
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->offset_ns, 1000);
  EXPECT_EQ(measured->shortest_ns, 200'000);
  EXPECT_EQ(measured->uncertainty_ns, 100'000);
}

TEST(ClockOffset, WhoeverSetsAWallClockTheBeginOfTheTraceCounts) {
  ClockOffset clock;
  clock.add(1000, at(kBegin), at(kBegin, kEpoch + 3 * kSecond));
  clock.keep_epoch();
  clock.add(1000, at(kBegin + 100), at(kBegin + 100, kEpoch - 3600 * kSecond));
  EXPECT_EQ(clock.measured()->epoch_ns, kEpoch);
  EXPECT_NEAR(static_cast<double>(clock.measured()->wall_offset_ns), 3e9, 1000);
}

TEST(ClockOffset, LongRunsTakeNoMoreMemoryAndNonsenseIsPassedOver) {
  ClockOffset clock;
  for (std::int64_t i = 0; i < 100'000; ++i) {
    clock.add(1000, at(kBegin + i * kSecond), at(kBegin + i * kSecond - 500 + 42));
  }
  EXPECT_EQ(clock.measured()->offset_ns, 42);
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  clock.add(-1, at(kBegin), at(kBegin));
  clock.add(1, at(kBegin), {.epoch_ns = kEpoch, .monotonic_ns = kMost});
  clock.add(1, at(kBegin), {.epoch_ns = kEpoch, .monotonic_ns = kLeast});
  clock.add(1, at(kBegin), {.epoch_ns = kMost, .monotonic_ns = kBegin});
  clock.add(1, at(kBegin), {.epoch_ns = kLeast, .monotonic_ns = kBegin});
  clock.add(1, {.epoch_ns = kEpoch, .monotonic_ns = -5}, at(kBegin));
  EXPECT_EQ(clock.measured()->round_trips, 100'000U);
}

TEST(ClockOffset, IsWrittenAsJson) {
  EXPECT_EQ(launch::clock_as_json("arm",
                                  {.at_ns = 1,
                                   .offset_ns = -2,
                                   .drift = 12.5e-6,
                                   .uncertainty_ns = 3,
                                   .epoch_ns = 6,
                                   .wall_offset_ns = 7,
                                   .shortest_ns = 4,
                                   .round_trips = 5},
                                  "boot-1"),
            "{\n  \"machine\": \"arm\",\n  \"offset_ns\": 7,\n  \"uncertainty_ns\": 3,\n  \"drift\": 0.000012500000,\n"
            "  \"monotonic\": {\"at_ns\": 1, \"offset_ns\": -2, \"epoch_ns\": 6, \"boot\": \"boot-1\"},\n"
            "  \"shortest_round_trip_ns\": 4,\n  \"round_trips\": 5\n}\n");
}

}  // namespace
