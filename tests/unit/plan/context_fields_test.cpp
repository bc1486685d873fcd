// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/context_fields.hpp"

#include <gtest/gtest.h>
#include <linux/perf_event.h>

#include <cstdint>
#include <string>

#include "tests/unit/plan/trace_error_text.hpp"

namespace {

using tracing::testing::error_of;

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
