// SPDX-License-Identifier: Apache-2.0
// Runs of one system differ by which of several messages comes last: what follows from that is no change.
#include <gmock/gmock.h>

#include "changed_subjects.hpp"
#include "made_up_runs.hpp"

namespace tracing::compare {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A fusion keeps each input but the last one, upon which it works and sends. `last`: which part of the messages of this
// subscription come last.
RunSummary run_with_fusion(std::uint64_t seed, double last, double work = 240 * kMicrosecond) {
  RunSummary summary = run(seed);
  Random random(seed + 2'000'000);
  const auto near = [&random](double usual) {
    return [&random, usual](int) { return usual * (1 + 0.05 * random.normal()); };
  };
  const int sending = static_cast<int>(kSamples * last);
  if (sending > 0) {
    summary.measurements.push_back(measurement("/fusion", near(work), sending));
    summary.measurements.back().sends = true;
  }
  if (sending < kSamples) {
    summary.measurements.push_back(measurement("/fusion", near(2 * kMicrosecond), kSamples - sending));
    summary.measurements.back().quantity = sending > 0 ? "duration without sending" : "duration";
    summary.measurements.back().sends = false;
  }
  return summary;
}

TEST(Comparison, WhichMessageComesLastIsNoChangeOfAFusion) {
  for (const double before : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    for (const double after : {0.0, 0.2, 0.5, 0.8, 1.0}) {
      const Comparison comparison = compared(run_with_fusion(9000, before), run_with_fusion(9001, after));
      EXPECT_THAT(subjects(comparison), IsEmpty()) << before << " of all messages last, then " << after;
      EXPECT_THAT(comparison.likely, IsEmpty());
    }
  }
  EXPECT_EQ(compared(run_with_fusion(9000, 0.0), run_with_fusion(9001, 1.0)).undecided, 2u)
      << "neither is on both sides";
  EXPECT_EQ(compared(run_with_fusion(9000, 0.5), run_with_fusion(9001, 1.0)).undecided, 1u);
  EXPECT_EQ(compared(run_with_fusion(9000, 0.5), run_with_fusion(9001, 0.8)).undecided, 0u);
}

TEST(Comparison, FindsTheSlowerWorkOfAFusion) {
  for (const double after : {0.4, 0.7, 1.0}) {
    const Comparison comparison =
        compared(run_with_fusion(9100, 0.5), run_with_fusion(9101, after, 2.24 * kMillisecond));
    EXPECT_THAT(subjects(comparison), ElementsAre("/fusion"));
    for (const Change& change : comparison.changes) {
      EXPECT_EQ(change.quantity, "duration");
    }
  }
}

// Of a former release: all runs of the callback.
TEST(Comparison, AFusionIsNotComparedWithABaselineThatDoesNotTellItsWorksApart) {
  RunSummary before = run_with_fusion(9200, 1.0);
  before.measurements.back().sends = std::nullopt;
  EXPECT_EQ(compared(before, run_with_fusion(9201, 1.0, 2.24 * kMillisecond)).changes.size(), 3u) << "it has one work";
  EXPECT_THAT(compared(before, run_with_fusion(9201, 0.5, 2.24 * kMillisecond)).changes, IsEmpty());
}

TEST(Comparison, AChainInWhichMessagesWaitNeedsThreeRuns) {
  const auto with_chain = [](std::uint64_t seed, double response, bool waits) {
    RunSummary summary = run(seed);
    Random random(seed + 3'000'000);
    Measurement chain = measurement("a -> b", [&](int) { return response * (1 + 0.02 * random.normal()); });
    chain.kind = Kind::kChain;
    chain.quantity = "response";
    chain.waits = waits;
    summary.measurements.push_back(chain);
    return summary;
  };
  const auto runs = [&](double response, std::uint64_t seed, int count) {
    Runs side;
    for (int i = 0; i < count; ++i) {
      side.runs.push_back(with_chain(seed + static_cast<std::uint64_t>(i), response, true));
    }
    return side;
  };
  const double fast = 3 * kMillisecond;
  const double slow = 60 * kMillisecond;
  const Comparison single = compared(with_chain(9300, fast, true), with_chain(9301, slow, true));
  EXPECT_THAT(single.changes, IsEmpty());
  EXPECT_EQ(single.undecided, 1u);
  EXPECT_THAT(subjects(compared(with_chain(9300, fast, false), with_chain(9301, slow, false))), ElementsAre("a -> b"));
  EXPECT_THAT(compare(runs(fast, 9300, 2), runs(slow, 9310, 3), {}).changes, IsEmpty());
  EXPECT_THAT(subjects(compare(runs(fast, 9300, 3), runs(slow, 9310, 3), {})), ElementsAre("a -> b"));
}

}  // namespace
}  // namespace tracing::compare
