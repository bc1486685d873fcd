// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <gtest/gtest.h>
#include <time.h>
#include <unistd.h>

#include <cstddef>

#include "tests/support/emulated.hpp"

namespace launch {
namespace {

TEST(ProcessUsage, CountsTheProcessorTimeAndTheMemoryOfAProcess) {
  NEEDS_PROC_SELF();
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

TEST(UsageReader, KeepsTheOrderOfManyProcesses) {
  std::vector<pid_t> pids(2003, -1);
  for (const std::size_t i : {0, 1000, 1001, 2002}) {
    pids[i] = ::getpid();
  }
  UsageReader reader;
  for (const pid_t pid : pids) {
    reader.add(pid);
  }
  const std::vector<std::optional<ProcessUsage>> usage = reader.take();
  ASSERT_EQ(usage.size(), pids.size());
  for (std::size_t i = 0; i < pids.size(); ++i) {
    EXPECT_EQ(usage[i].has_value(), pids[i] > 0) << i;
  }
}

TEST(UsageReader, ReadsFewProcessesWithoutOtherThreads) {
  UsageReader reader;
  reader.add(::getpid());
  reader.add(-1);
  const std::vector<std::optional<ProcessUsage>> usage = reader.take();
  ASSERT_EQ(usage.size(), 2U);
  EXPECT_TRUE(usage[0]);
  EXPECT_FALSE(usage[1]);
}

TEST(UsageReader, MayBeGivenUp) {
  EXPECT_TRUE(UsageReader().take().empty());
  UsageReader reader;
  for (int i = 0; i < 1000; ++i) {
    reader.add(::getpid());
  }
}

}  // namespace
}  // namespace launch
