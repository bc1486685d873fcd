// What LTTng's kernel tracer would get wrong without a word, found before a session exists.
#include "tracing/session/kernel_checks.hpp"

#include <gtest/gtest.h>

#include "tests/unit/session/trace_error_text.hpp"

namespace {

using tracing::ChannelPlan;
using tracing::testing::error_of;

std::string error_of_names(const std::vector<std::string>& patterns, const std::vector<std::string>& syscalls) {
  ChannelPlan plan{.domain = LTTNG_DOMAIN_KERNEL};
  for (const std::string& pattern : patterns) plan.events.push_back({.pattern = pattern});
  plan.syscalls = syscalls;
  return error_of([&] { tracing::check_kernel_names({plan}, {"irq_handler_entry", "sched_switch"}, {"openat"}); });
}

TEST(KernelChecks, EveryNameAndPatternMustMeanSomething) {
  EXPECT_EQ(error_of_names({"sched_*", "irq_handler_entry", "lttng_statedump_start"}, {"*"}), "no error");
  EXPECT_EQ(error_of_names({"sched_swich"}, {}), "the kernel has no event 'sched_swich'\ndid you mean `sched_switch`?");
  EXPECT_EQ(error_of_names({"net_*"}, {}), "the kernel has no event 'net_*'\n`launch trace events` lists them");
  EXPECT_EQ(error_of_names({}, {"opennat"}), "the kernel has no system call 'opennat'\ndid you mean `openat`?");
  EXPECT_EQ(error_of_names({}, {"sys_clone"}),
            "the kernel has no system call 'sys_clone'\nname it without 'sys_', as in openat");
}

TEST(KernelChecks, TheContextFieldThatCrashesTheKernelIsRefused) {
  const auto error_with = [](lttng_domain_type domain, const std::string& version) {
    const ChannelPlan plan{.domain = domain, .context_fields = {"tid", "prio"}};
    return error_of([&] { tracing::check_kernel_context_fields({plan}, version); });
  };
  EXPECT_EQ(error_with(LTTNG_DOMAIN_KERNEL, "2.13.9"),
            "context field 'prio' would crash this kernel: LTTng's modules 2.13.9 call a function that they never look "
            "up\nleave it out; sched_switch tells prev_prio and next_prio");
  EXPECT_EQ(error_with(LTTNG_DOMAIN_KERNEL, "2.14.0"), "no error");
  EXPECT_EQ(error_with(LTTNG_DOMAIN_UST, "2.13.9"), "no error");
}

}  // namespace
