// SPDX-License-Identifier: Apache-2.0
// What delays a quantity for a whole run, and is no change.
#include "tracing/model/compare/disturbance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracing/model/compare/comparison.hpp"

namespace tracing::compare {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kCalls = 200;
constexpr std::int64_t kUs = 1'000;

// Values of a fixed pattern, some of which are 2 % larger.
Measurement even(Kind kind, const std::string& subject, const std::string& quantity, std::int64_t ns) {
  Measurement one{kind, subject, quantity, {}, kCalls, {}, false};
  for (int i = 0; i < kCalls; ++i) {
    one.samples.push_back(ns + (i * 7 % 10) * ns / 500);
  }
  return one;
}

// Two callbacks, of 100 and 400 us, and a message that waits so long for its executor.
RunSummary waiting(std::int64_t wait_ns, std::int64_t longer_ns = 0) {
  RunSummary run;
  run.measurements.push_back(even(Kind::kCallback, "/a", "duration", 100 * kUs + longer_ns));
  run.measurements.push_back(even(Kind::kCallback, "/b", "duration", 400 * kUs));
  run.measurements.push_back(even(Kind::kHop, "/t to /a", "waiting for the executor", wait_ns));
  return run;
}

std::vector<std::string> found(const std::vector<Change>& changes) {
  std::vector<std::string> names;
  for (const Change& change : changes) {
    names.push_back(change.subject + " " + statistic_name(change.statistic));
  }
  return names;
}

TEST(Disturbance, OtherCallbacksAreThoseOfTheRunWhereTheyTakeLess) {
  const Disturbances usual = disturbances_of(waiting(0));
  const Disturbances slow = disturbances_of(waiting(0, 5000 * kUs));
  const std::vector<Measurement> all = waiting(0).measurements;
  const auto longest = [&](const Disturbances& before, const Disturbances& after, const Measurement& self) {
    return disturbance_between(before, after, self).longest_ns / kUs;
  };
  EXPECT_NEAR(longest(usual, slow, all[0]), 404, 1);  // /a is delayed by /b,
  EXPECT_NEAR(longest(usual, slow, all[1]), 101, 1);  // /b by /a,
  EXPECT_NEAR(longest(usual, slow, all[2]), 404, 1);  // and a message by each
  EXPECT_NEAR(longest(slow, usual, all[2]), 404, 1);
  EXPECT_NEAR(disturbance_between(usual, slow, all[2]).longest_two_ns / kUs, 505, 1);
}

// Timers of the other run have other phases, so that the message comes while /b runs, each time.
TEST(Disturbance, AMessageThatMeetsARunningCallbackInOneRunIsNoChange) {
  const Comparison comparison = compare({"before", {waiting(10 * kUs)}}, {"after", {waiting(380 * kUs)}}, {});
  EXPECT_THAT(found(comparison.changes), IsEmpty());
  EXPECT_THAT(found(comparison.likely), IsEmpty());
}

TEST(Disturbance, ALongerWaitThanThatIsAChange) {
  const Comparison comparison = compare({"before", {waiting(10 * kUs)}}, {"after", {waiting(900 * kUs)}}, {});
  EXPECT_THAT(found(comparison.changes), ElementsAre("/t to /a p10", "/t to /a median", "/t to /a p90"));
}

TEST(Disturbance, OneRunMayHaveMetPhasesThatManyOthersHaveNot) {
  const RunSummary usual = waiting(10 * kUs);
  const RunSummary other = waiting(380 * kUs);
  EXPECT_THAT(found(compare({"before", {usual, usual, usual}}, {"after", {other}}, {}).changes), IsEmpty());
  EXPECT_THAT(found(compare({"before", {usual, usual, usual}}, {"after", {other, other, other}}, {}).changes),
              ElementsAre("/t to /a p10", "/t to /a median", "/t to /a p90"));
}

// The fastest runs of a callback are those that nothing was in the way of.
TEST(Disturbance, ACallbackThatTakesLongerIsFoundByItsFastestRuns) {
  EXPECT_THAT(found(compare({"before", {waiting(0)}}, {"after", {waiting(0, 60 * kUs)}}, {}).changes),
              ElementsAre("/a p10"));
}

}  // namespace
}  // namespace tracing::compare
