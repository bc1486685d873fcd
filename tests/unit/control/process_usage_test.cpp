// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <gtest/gtest.h>
#include <time.h>
#include <unistd.h>

namespace launch {
namespace {

TEST(ProcessUsage, CountsTheProcessorTimeAndTheMemoryOfAProcess) {
  timespec used{};
  do {
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  } while (used.tv_sec == 0 && used.tv_nsec < 50'000'000);
  const std::optional<ProcessUsage> usage = read_process_usage(::getpid());
  ASSERT_TRUE(usage);
  EXPECT_GE(usage->cpu, 0.02);
  EXPECT_LT(usage->cpu, 60);
  EXPECT_GT(usage->memory, 1024U * 1024U);
}

TEST(ProcessUsage, IsUnknownOfAProcessThatHasGone) {
  EXPECT_FALSE(read_process_usage(-1));
}

}  // namespace
}  // namespace launch
