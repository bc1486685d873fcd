// SPDX-License-Identifier: Apache-2.0
// Between ROS profiles and the quality of service of Fast DDS, as rmw_fastrtps_cpp maps them.
#pragma once

#include "rmw/types.h"

namespace eprosima::fastdds::dds {
class DataReaderQos;
class DataWriterQos;
class ReaderQos;
class WriterQos;
}  // namespace eprosima::fastdds::dds

namespace eprosima::fastrtps {
struct Time_t;
}

namespace rmw_fastrtps {

// Changes of `qos` what the profile states; SYSTEM_DEFAULT and unspecified durations leave it alone. Throws
// std::runtime_error for policies that a publisher or subscription cannot be created with.
void apply_profile(const rmw_qos_profile_t& profile, eprosima::fastdds::dds::DataWriterQos& qos);
void apply_profile(const rmw_qos_profile_t& profile, eprosima::fastdds::dds::DataReaderQos& qos);

rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::DataWriterQos& qos);
rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::DataReaderQos& qos);

// Of a discovered endpoint. Its history is not announced, nor is the lifespan of a reader: unknown and infinite.
rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::WriterQos& qos);
rmw_qos_profile_t profile_of(const eprosima::fastdds::dds::ReaderQos& qos);

// Infinite if Fast DDS cannot express it, beyond 68 years.
eprosima::fastrtps::Time_t to_dds(const rmw_time_t& time);

}  // namespace rmw_fastrtps
