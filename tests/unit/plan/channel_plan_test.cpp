// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/channel_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/plan/trace_error_text.hpp"
#include "tracing/record/plan/buffer_sizes.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace {

using tracing::TraceConfig;
using tracing::testing::error_of;

TEST(ChannelPlan, TakesNamesOnceAndOnlyUsedDomains) {
  TraceConfig config;
  config.events_ust = {"ros2:a", "ros2:b", "ros2:a"};
  std::vector<std::string> warnings;
  const auto plans = tracing::plan_channels(config, warnings);
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].channel, "ros2");
  ASSERT_EQ(plans[0].events.size(), 2u);
  EXPECT_EQ(plans[0].events[1].pattern, "ros2:b");
  EXPECT_FALSE(plans[0].overwrite);
  EXPECT_TRUE(warnings.empty());
}

TEST(ChannelPlan, LoggersOfPythonHaveTheChannelOfLttng) {
  TraceConfig config;
  config.events_python = {"planner:*", "costs level ERR", "*", "x level DEBUG if lineno > 5"};
  config.snapshot_mode = true;
  std::vector<std::string> warnings;
  const auto plans = tracing::plan_channels(config, warnings);
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[1].channel, "lttng_python_channel");
  EXPECT_TRUE(plans[1].overwrite);
  std::vector<std::string> names;
  for (const tracing::EventRule& rule : plans[1].events) {
    names.push_back(rule.pattern);
  }
  EXPECT_THAT(names, testing::ElementsAre("planner", "planner.*", "costs", "*", "x"));
  EXPECT_EQ(plans[1].events[2].log_level, 40);
  EXPECT_EQ(plans[1].events[4].log_level, 10);
  EXPECT_EQ(plans[1].events[4].filter, "lineno > 5");
  config.events_python = {"planner.* except planner.local"};
  EXPECT_EQ(error_of([&] { tracing::plan_channels(config, warnings); }),
            "nothing can be taken out of the loggers 'planner.*'\n"
            "name the loggers one by one, or use a filter such as `if logger_name != \"my_logger\"`");
}

TEST(ChannelPlan, RuntimeHalfOfADualSessionWantsNoStateDumps) {
  TraceConfig config;
  config.events_ust = {"ros2:*"};
  config.dual_runtime = true;
  std::vector<std::string> warnings;
  const auto plans = tracing::plan_channels(config, warnings);
  ASSERT_EQ(plans.size(), 1u);
  ASSERT_EQ(plans[0].events.size(), 2u);
  EXPECT_EQ(plans[0].events[1].pattern, "ros2_session:no_state_dump");
}

TEST(ChannelPlan, FitsIntoTheSharedMemoryThatThereIs) {
  TraceConfig config;  // 4 x 1 MiB
  std::vector<std::string> warnings;
  auto plans = tracing::plan_channels(config, warnings);
  const std::uint64_t mib = std::uint64_t{1} << 20;
  tracing::fit_into_shared_memory(plans, 64 * mib, 8, warnings);
  EXPECT_EQ(plans[0].subbuffer_size, mib);
  EXPECT_TRUE(warnings.empty());
  tracing::fit_into_shared_memory(plans, 64 * mib, 32, warnings);
  EXPECT_EQ(plans[0].subbuffer_size, mib / 4);
  EXPECT_THAT(warnings, testing::ElementsAre(
                            "/dev/shm has 67108864 bytes left, and the buffers would need 142606336: sub-buffers "
                            "are made smaller, 262144 bytes; more room is given to a container with --shm-size"));
  EXPECT_EQ(error_of([&] { tracing::fit_into_shared_memory(plans, mib, 32, warnings); }),
            "the buffers need 4456448 bytes of shared memory, and /dev/shm has 1048576 left\n"
            "give it more (in a container with --shm-size), or leave channels out");
}

TEST(ChannelPlan, HasAKernelChannelForSystemCalls) {
  TraceConfig config;
  config.syscalls = {"openat"};
  config.snapshot_mode = true;
  std::vector<std::string> warnings;
  const auto plans = tracing::plan_channels(config, warnings);
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[1].channel, "kchan");
  EXPECT_EQ(plans[1].subbuffer_size, 131072u);
  EXPECT_TRUE(plans[0].overwrite && plans[1].overwrite);
}

TEST(ChannelPlan, RoundsSubbuffersUpToAPageAndAPowerOfTwo) {
  TraceConfig config;
  config.ust.subbuffer_size = 1;
  std::vector<std::string> warnings;
  EXPECT_EQ(tracing::plan_channels(config, warnings)[0].subbuffer_size, static_cast<std::uint64_t>(getpagesize()));
  config.ust.subbuffer_size = 65537;
  EXPECT_EQ(tracing::plan_channels(config, warnings)[0].subbuffer_size, 131072u);
  EXPECT_EQ(warnings.size(), 2u);
  config.ust.subbuffer_size = ~std::uint64_t{0};
  EXPECT_EQ(error_of([&] { tracing::plan_channels(config, warnings); }),
            "sub-buffer size of 18446744073709551615 bytes for the ust domain is too large\n");
}

}  // namespace
