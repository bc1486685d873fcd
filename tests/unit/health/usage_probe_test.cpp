// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/usage_probe.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "tests/support/emulated.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kMebi = 1024 * 1024;

class UsageProbes : public testing::Test {
 protected:
  UsageOf usage() {
    return [this](pid_t) { return usage_; };
  }
  Look look(HealthProbe& probe, std::uint64_t mebi, double cpu = 0, Duration passed = 1s) {
    usage_ = ProcessUsage{.cpu = cpu, .memory = mebi * kMebi};
    return probe.look(now_ += passed, passed);
  }

  std::optional<ProcessUsage> usage_;
  Duration now_ = 100s;
};

TEST_F(UsageProbes, MemoryMayBeLargeForLessThanTheTimeout) {
  MemoryProbe probe({.most = 100 * kMebi, .most_growth = {}}, 3s, 0s, usage());
  probe.begin(1);
  EXPECT_EQ(look(probe, 100).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 200).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 200).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 90).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 101).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 101).result, Look::Result::kGood);
  const Look bad = look(probe, 120);
  EXPECT_EQ(bad.result, Look::Result::kBad);
  EXPECT_EQ(bad.why, "it has had more than 100.0 MiB of memory for 3.0 s, now 120.0 MiB");
}

TEST_F(UsageProbes, GrowthCountsFromTheEndOfTheStartPeriod) {
  MemoryProbe probe({.most = {}, .most_growth = 10 * kMebi}, 1s, 2s, usage());
  probe.begin(1);
  EXPECT_EQ(look(probe, 1).result, Look::Result::kGood);
  EXPECT_EQ(look(probe, 50).result, Look::Result::kGood) << "it has started";
  EXPECT_EQ(look(probe, 60).result, Look::Result::kGood);
  const Look bad = look(probe, 61);
  EXPECT_EQ(bad.result, Look::Result::kBad);
  EXPECT_EQ(bad.why, "its memory has been more than 10.0 MiB above 50.0 MiB for 1.0 s, now 61.0 MiB");
  EXPECT_EQ(look(probe, 40).result, Look::Result::kGood);
  probe.begin(2);
  EXPECT_EQ(look(probe, 90).result, Look::Result::kGood) << "another run";
}

TEST_F(UsageProbes, LoadIsThatOfTheTimeout) {
  LoadProbe probe({.most = 0.5}, 3s, usage());
  probe.begin(1);
  EXPECT_EQ(look(probe, 1, 10).result, Look::Result::kPending) << "what was used before is not known";
  EXPECT_EQ(look(probe, 1, 11).result, Look::Result::kPending);
  EXPECT_EQ(look(probe, 1, 12).result, Look::Result::kPending);
  const Look bad = look(probe, 1, 12.6);
  EXPECT_EQ(bad.result, Look::Result::kBad);
  EXPECT_EQ(bad.why, "it has used 87 % of a processor for 3.0 s");
  EXPECT_EQ(look(probe, 1, 12.6).result, Look::Result::kBad) << "1.6 s in 3 s";
  EXPECT_EQ(look(probe, 1, 12.6).result, Look::Result::kGood) << "0.6 s in 3 s";
}

TEST_F(UsageProbes, TimeThatDoesNotCountHasNoLoad) {
  LoadProbe probe({.most = 0.5}, 1s, usage());
  probe.begin(1);
  look(probe, 1, 10);
  EXPECT_EQ(look(probe, 1, 50, 0s).result, Look::Result::kPending) << "the machine was suspended";
  EXPECT_EQ(look(probe, 1, 50.1).result, Look::Result::kGood);
}

TEST_F(UsageProbes, NothingIsSaidOfAProcessThatHasGone) {
  MemoryProbe memory({.most = 1, .most_growth = {}}, 1s, 0s, usage());
  LoadProbe load({.most = 0.5}, 1s, usage());
  EXPECT_EQ(memory.look(1s, 1s).result, Look::Result::kPending);
  EXPECT_EQ(load.look(1s, 1s).result, Look::Result::kPending);
}

TEST_F(UsageProbes, AProcessIsReallyLookedAt) {
  NEEDS_PROC_SELF();
  MemoryProbe probe({.most = 1, .most_growth = {}}, 1s, 0s);
  probe.begin(::getpid());
  EXPECT_EQ(probe.look(1s, 1s).result, Look::Result::kBad);
}

}  // namespace
}  // namespace launch
