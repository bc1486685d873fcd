// SPDX-License-Identifier: Apache-2.0
// With TRACETOOLS_DISABLED the macros produce nothing, and no library is linked.
#include <gtest/gtest.h>

#include "tracetools/tracetools.h"

#ifndef TRACETOOLS_DISABLED
#error "this test is about the configuration without tracepoints"
#endif

namespace {

TEST(DisabledMacros, DoNotEvaluateTheirArguments) {
  int evaluations = 0;
  TRACETOOLS_TRACEPOINT(rcl_take, &++evaluations);
  TRACETOOLS_DO_TRACEPOINT(rcl_take, &++evaluations);
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  EXPECT_EQ(evaluations, 0);
}

TEST(DisabledMacros, AreNeverEnabled) {
  EXPECT_FALSE(TRACETOOLS_TRACEPOINT_ENABLED(rcl_take));
}

}  // namespace
