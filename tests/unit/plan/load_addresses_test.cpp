// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/load_addresses.hpp"

#include <gtest/gtest.h>

namespace {

using tracing::records_load_addresses;

TEST(LoadAddresses, AreRecordedByTheEventsThatHaveThem) {
  for (const char* event : {"lttng_ust_statedump:bin_info", "lttng_ust_statedump:*", "lttng_ust_lib:load", "*:build_id",
                            "lttng_ust_lib:unload if ip != 0", "lttng*", "*"}) {
    EXPECT_TRUE(records_load_addresses({"ros2:rcl_init", event})) << event;
  }
}

TEST(LoadAddresses, AreNotRecordedByOtherEvents) {
  for (const char* event : {"ros2:*", "lttng_ust_statedump:procname", "lttng_ust_statedump:start", "lttng_ust_libc:*",
                            "lttng_ust_cyg_profile:*"}) {
    EXPECT_FALSE(records_load_addresses({event})) << event;
  }
  EXPECT_FALSE(records_load_addresses({}));
}

}  // namespace
