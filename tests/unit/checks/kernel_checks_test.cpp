// SPDX-License-Identifier: Apache-2.0
// Finds settings that LTTng's kernel tracer would silently handle wrongly, before a session exists.
#include "tracing/record/checks/kernel_checks.hpp"

#include <gtest/gtest.h>

#include "tests/unit/plan/trace_error_text.hpp"
#include "tracing/record/plan/channel_plan.hpp"

namespace {

using tracing::ChannelPlan;
using tracing::testing::error_of;

// What is left is the plan's; an error, or the warning.
std::string unknown_names(const std::vector<std::string>& patterns, const std::vector<std::string>& syscalls) {
  ChannelPlan plan;
  plan.domain = LTTNG_DOMAIN_KERNEL;
  for (const std::string& pattern : patterns) {
    plan.events.push_back({.pattern = pattern});
  }
  plan.syscalls = syscalls;
  std::string warning;
  const std::string error = error_of([&] {
    std::vector<ChannelPlan> plans = {plan, ChannelPlan()};
    warning = tracing::drop_unknown_kernel_names(plans, {"irq_handler_entry", "sched_switch"}, {"openat"});
    EXPECT_EQ(plans.size(), 2U);
    for (const auto& rule : plans.front().events) {
      warning += " left: " + rule.pattern;
    }
    for (const std::string& name : plans.front().syscalls) {
      warning += " left: " + name;
    }
  });
  return error == "no error" ? warning : error;
}

TEST(KernelChecks, NamesAndPatternsThatMeanNothingAreDroppedWithAWarning) {
  EXPECT_EQ(unknown_names({"sched_*", "lttng_statedump_start"}, {"*"}),
            " left: sched_* left: lttng_statedump_start left: *");
  EXPECT_EQ(unknown_names({"sched_swich", "sched_switch"}, {"sys_clone", "openat"}),
            "not recorded, for the kernel has no event 'sched_swich' (did you mean `sched_switch`?), no system call "
            "'sys_clone' (name it without 'sys_', as in openat) left: sched_switch left: openat");
}

TEST(KernelChecks, NothingToRecordIsAnError) {
  EXPECT_EQ(unknown_names({"sched_swich"}, {}), "the kernel has no event 'sched_swich'\ndid you mean `sched_switch`?");
  EXPECT_EQ(unknown_names({"net_*"}, {"opennat"}), "the kernel has no event 'net_*'\n`launch trace events` lists them");
  EXPECT_EQ(unknown_names({}, {"opennat"}), "the kernel has no system call 'opennat'\ndid you mean `openat`?");
  EXPECT_EQ(unknown_names({}, {"sys_clone"}),
            "the kernel has no system call 'sys_clone'\nname it without 'sys_', as in openat");
}

TEST(KernelChecks, AChannelWithoutAnyKnownNameIsDropped) {
  std::vector<ChannelPlan> plans(2);
  plans[0].domain = plans[1].domain = LTTNG_DOMAIN_KERNEL;
  plans[0].events.push_back({.pattern = "net_*"});
  plans[1].events.push_back({.pattern = "sched_switch"});
  EXPECT_EQ(tracing::drop_unknown_kernel_names(plans, {"sched_switch"}, {}),
            "not recorded, for the kernel has no event 'net_*' (`launch trace events` lists them)");
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].events[0].pattern, "sched_switch");
}

TEST(KernelChecks, TheContextFieldThatCrashesTheKernelIsRefused) {
  const auto error_with = [](lttng_domain_type domain, const std::string& version) {
    ChannelPlan plan;
    plan.domain = domain;
    plan.context_fields = {"tid", "prio"};
    return error_of([&] { tracing::check_kernel_context_fields({plan}, version); });
  };
  EXPECT_EQ(error_with(LTTNG_DOMAIN_KERNEL, "2.13.9"),
            "context field 'prio' would crash this kernel: LTTng's modules 2.13.9 call a function that they never look "
            "up\nleave it out; sched_switch tells prev_prio and next_prio");
  EXPECT_EQ(error_with(LTTNG_DOMAIN_KERNEL, "2.14.0"), "no error");
  EXPECT_EQ(error_with(LTTNG_DOMAIN_UST, "2.13.9"), "no error");
}

}  // namespace
