// SPDX-License-Identifier: Apache-2.0
// The transport of Fast DDS that loses messages on purpose, for tests.
#pragma once

#include "fastdds_versions/names.hpp"

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/rtps/common/CDRMessage_t.hpp>
#include <fastdds/rtps/transport/test_UDPv4TransportDescriptor.hpp>
#else
#include <fastdds/rtps/common/CDRMessage_t.h>
#include <fastrtps/transport/test_UDPv4TransportDescriptor.h>

namespace rmw_fastrtps::rtps {
using eprosima::fastdds::rtps::test_UDPv4TransportDescriptor;
}  // namespace rmw_fastrtps::rtps
#endif
