// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rmw/types.h"

namespace rmw_fastrtps {

// What ros2_ext:rmw_publisher_qos and rmw_subscription_qos record of a profile.
struct TracedQos {
  explicit TracedQos(const rmw_qos_profile_t& profile)
      : reliable(profile.reliability == RMW_QOS_POLICY_RELIABILITY_RELIABLE),
        history_depth(profile.history == RMW_QOS_POLICY_HISTORY_KEEP_ALL ? 0 : profile.depth),
        transient_local(profile.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL) {}

  bool reliable;
  std::uint64_t history_depth;  // 0: all messages are kept
  bool transient_local;
};

}  // namespace rmw_fastrtps
