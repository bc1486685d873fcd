// SPDX-License-Identifier: Apache-2.0
// Converts between ROS profiles and the quality of service of Fast DDS, as rmw_fastrtps_cpp does.
#pragma once

#include <cstdint>

#include "fastdds_versions/names.hpp"
#include "rmw/types.h"

namespace eprosima::fastdds::dds {
class DataReaderQos;
class DataWriterQos;
}  // namespace eprosima::fastdds::dds

namespace rmw_fastrtps {

struct FoundEndpoint;

// Sets the policies of `qos` that the profile states; leaves it alone for SYSTEM_DEFAULT and unspecified durations.
// Throws std::runtime_error for policies that a publisher or subscription cannot be created with.
void apply_profile(const rmw_qos_profile_t& profile, eprosima::fastdds::dds::DataWriterQos& qos);
void apply_profile(const rmw_qos_profile_t& profile, eprosima::fastdds::dds::DataReaderQos& qos);

rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::DataWriterQos& qos);
rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::DataReaderQos& qos);

// The profile of a discovered endpoint. Two policies are not announced: the history is unknown, a reader's lifespan
// infinite.
rmw_qos_profile_t profile_of(const FoundEndpoint& endpoint);

// Infinite if Fast DDS cannot express the duration, beyond 68 years.
DdsDuration to_dds(const rmw_time_t& time);

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
