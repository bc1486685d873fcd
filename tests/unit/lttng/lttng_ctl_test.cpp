// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/lttng_ctl.hpp"

#include <gmock/gmock.h>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

TEST(LttngCtl, AFunctionIsThatOfTheLibrary) {
  EXPECT_STREQ(lttng_strerror(-LTTNG_ERR_NO_SESSIOND), "No session daemon is available");
  lttng_endpoint* const endpoint = lttng_notification_endpoint();
  EXPECT_NE(endpoint, nullptr);
}

TEST(LttngCtl, AFunctionThatTheLibraryLacksIsAnError) {
  try {
    lttng_address("lttng_fly");
    FAIL() << "found";
  } catch (const TraceError& error) {
    EXPECT_THAT(error.what(),
                testing::MatchesRegex("cannot use LTTng's control library: .*liblttng-ctl.so.0: undefined "
                                      "symbol: lttng_fly"));
    EXPECT_EQ(error.remedy(), "install lttng-tools");
  }
}

}  // namespace
}  // namespace tracing
