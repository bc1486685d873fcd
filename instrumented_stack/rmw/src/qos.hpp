// Between ROS profiles and the quality of service of Fast DDS, as rmw_fastrtps_cpp maps them.
#pragma once

#include "rmw/types.h"

namespace eprosima::fastdds::dds {
class DataReaderQos;
class DataWriterQos;
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

// Infinite if Fast DDS cannot express it, beyond 68 years.
eprosima::fastrtps::Time_t to_dds(const rmw_time_t& time);

}  // namespace rmw_fastrtps
