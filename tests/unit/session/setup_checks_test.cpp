// SPDX-License-Identifier: Apache-2.0
// What fails before LTTng is asked: names, directories, context fields, sizes.
#include "tracing/session/setup_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/unit/session/trace_error_text.hpp"
#include "tracing/session/channel_plan.hpp"
#include "tracing/session/context_fields.hpp"
#include "tracing/session/perf_check.hpp"
#include "tracing/session/perf_counters.hpp"
#include "tracing/session/plan_channels.hpp"
#include "tracing/session/session_daemon.hpp"
#include "tracing/session/shared_memory_fit.hpp"
#include "tracing/session/trace_config.hpp"

namespace {

using tracing::TraceConfig;
using tracing::testing::error_of;

struct SetupChecks : testing::Test {
  SetupChecks() {
    std::string name = (std::filesystem::temp_directory_path() / "setup-checks-XXXXXX").string();
    directory = mkdtemp(name.data());
    config.session_name = "run";
    config.base_path = directory / "traces";
  }
  ~SetupChecks() override { std::filesystem::remove_all(directory); }

  std::string config_error() const {
    return error_of([this] { tracing::check_config(config); });
  }

  std::filesystem::path directory;
  TraceConfig config;
};

TEST_F(SetupChecks, AcceptABaseDirectoryThatIsYetToBeCreatedAndCreateNothing) {
  config.base_path = directory / "a" / "b" / "c";
  EXPECT_EQ(config_error(), "no error");
  EXPECT_TRUE(std::filesystem::is_empty(directory));
}

TEST_F(SetupChecks, RefuseAnEmptyName) {
  config.session_name.clear();
  EXPECT_EQ(config_error(), "the trace session's name is empty\ngive it a session-name");
}

TEST_F(SetupChecks, RefuseASlashInTheName) {
  config.session_name = "a/b";
  EXPECT_EQ(config_error(),
            "trace session name 'a/b' contains a '/'\nthe directory that will hold the trace is given by base-path");
}

TEST_F(SetupChecks, RefuseANameThatLttngWouldCut) {
  config.session_name = std::string(255, 'n');
  EXPECT_EQ(config_error(), "trace session name '" + config.session_name + "' is longer than 254 characters\n");
}

TEST_F(SetupChecks, RefuseATraceWithoutEvents) {
  config.events_ust.clear();
  EXPECT_EQ(config_error(),
            "no events enabled for trace session 'run'\nname some in events-ust, events-kernel or syscalls");
  config.syscalls = {"openat"};
  EXPECT_EQ(config_error(), "no error");
}

TEST_F(SetupChecks, RefuseADirectoryThatExistsUnlessAppending) {
  std::filesystem::create_directories(directory / "traces" / "run");
  EXPECT_EQ(config_error(),
            "trace directory " + config.trace_directory() +
                " exists already\nset append-trace to true to add to it, or choose another session-name");
  config.append_trace = true;
  EXPECT_EQ(config_error(), "no error");
}

TEST_F(SetupChecks, WarnOfThreadCountersThatCannotBeCounted) {
  EXPECT_TRUE(tracing::perf_warnings({"vpid", "vtid"}).empty());
  const std::string impossible = "perf:thread:iTLB-stores";  // nothing stores through the instruction TLB
  EXPECT_THAT(tracing::perf_warnings({"vpid", impossible}),
              testing::ElementsAre(testing::AllOf(
                  testing::StartsWith("context field 'perf:thread:iTLB-stores' cannot be counted here ("),
                  testing::EndsWith("): LTTng will record no events; leave it out, or see whether "
                                    "/proc/sys/kernel/perf_event_paranoid forbids it"))));
}

TEST_F(SetupChecks, TakeARunningSessionDaemonOnly) {
  const std::string pid_file = directory / "lttng-sessiond.pid";
  const auto error = [&] { return error_of([&] { tracing::check_daemon_is_here(pid_file); }); };
  EXPECT_EQ(error(), "no error");  // no file, no objection
  test_support::write_file(pid_file, std::to_string(getpid()) + "\n");
  EXPECT_EQ(error(),
            "the LTTng session daemon exists but is unreachable: " + pid_file + " names process " +
                std::to_string(getpid()) +
                ", which is not a lttng-sessiond here\nanother container shares this home directory: give each "
                "container its own LTTNG_HOME (LTTng bug 1371)");
}

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
  config.subbuffer_size_ust = 1;
  std::vector<std::string> warnings;
  EXPECT_EQ(tracing::plan_channels(config, warnings)[0].subbuffer_size, static_cast<std::uint64_t>(getpagesize()));
  config.subbuffer_size_ust = 65537;
  EXPECT_EQ(tracing::plan_channels(config, warnings)[0].subbuffer_size, 131072u);
  EXPECT_EQ(warnings.size(), 2u);
  config.subbuffer_size_ust = ~std::uint64_t{0};
  EXPECT_EQ(error_of([&] { tracing::plan_channels(config, warnings); }),
            "sub-buffer size of 18446744073709551615 bytes for the ust domain is too large\n");
}

std::string field_error(const std::string& name, lttng_domain_type domain) {
  return error_of([&] { tracing::ContextField(name, domain); });
}

TEST(ContextField, KnowsWhichDomainHasWhich) {
  EXPECT_EQ(tracing::ContextField("vtid", LTTNG_DOMAIN_UST).get()->ctx, LTTNG_EVENT_CONTEXT_VTID);
  EXPECT_EQ(tracing::ContextField("prio", LTTNG_DOMAIN_KERNEL).get()->ctx, LTTNG_EVENT_CONTEXT_PRIO);
  EXPECT_EQ(field_error("pid", LTTNG_DOMAIN_UST),
            "context field 'pid' does not exist for userspace events\ndid you mean `vpid`?");
  EXPECT_EQ(
      field_error("pthread_id", LTTNG_DOMAIN_KERNEL),
      "context field 'pthread_id' does not exist for kernel events\nlttng-add-context(1) lists the context fields");
}

TEST(ContextField, SuggestsTheNearestName) {
  EXPECT_EQ(field_error("vpdi", LTTNG_DOMAIN_UST), "unknown context field 'vpdi'\ndid you mean `vpid`?");
  EXPECT_EQ(field_error("quite_another_thing", LTTNG_DOMAIN_UST),
            "unknown context field 'quite_another_thing'\nlttng-add-context(1) lists the context fields");
}

TEST(ContextField, TakesPerformanceCounters) {
  tracing::ContextField field("perf:thread:L1-dcache-load-misses", LTTNG_DOMAIN_UST);
  EXPECT_EQ(field.get()->ctx, LTTNG_EVENT_CONTEXT_PERF_THREAD_COUNTER);
  EXPECT_EQ(field.get()->u.perf_counter.type, static_cast<std::uint32_t>(PERF_TYPE_HW_CACHE));
  EXPECT_EQ(field.get()->u.perf_counter.config, 0x10000u);
  EXPECT_STREQ(field.get()->u.perf_counter.name, "perf_thread_L1_dcache_load_misses");
  EXPECT_EQ(field_error("perf:cpu:cycles", LTTNG_DOMAIN_UST),
            "context field 'perf:cpu:cycles' does not exist for userspace events\nthere it is `perf:thread:COUNTER`");
  EXPECT_EQ(
      field_error("perf:cpu:cycels", LTTNG_DOMAIN_KERNEL),
      "unknown performance counter in context field 'perf:cpu:cycels'\nlttng-add-context(1) lists them; raw ones are "
      "written raw:rN:NAME");
}

TEST(ContextField, TakesContextsOfTheApplication) {
  tracing::ContextField field("$app.provider:type", LTTNG_DOMAIN_UST);
  EXPECT_EQ(field.get()->ctx, LTTNG_EVENT_CONTEXT_APP_CONTEXT);
  EXPECT_STREQ(field.get()->u.app_ctx.provider_name, "provider");
  EXPECT_STREQ(field.get()->u.app_ctx.ctx_name, "type");
  EXPECT_EQ(field_error("$app.provider", LTTNG_DOMAIN_UST),
            "malformed context field '$app.provider'\nwrite it as $app.PROVIDER:TYPE");
}

TEST(PerfCounter, ParsesRawOnes) {
  const auto counter = tracing::find_perf_counter("raw:r1C7:my-count");
  ASSERT_TRUE(counter.has_value());
  EXPECT_EQ(counter->type, static_cast<std::uint32_t>(PERF_TYPE_RAW));
  EXPECT_EQ(counter->config, 0x1c7u);
  EXPECT_EQ(counter->name, "my-count");
  for (const char* malformed : {"raw:r", "raw:rZ:name", "raw:r1C7", "raw:r1C7:", "LLC-bytes", ""}) {
    EXPECT_FALSE(tracing::find_perf_counter(malformed).has_value()) << malformed;
  }
}

}  // namespace
