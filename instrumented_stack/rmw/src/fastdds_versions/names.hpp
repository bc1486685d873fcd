// SPDX-License-Identifier: Apache-2.0
// The names of Fast DDS 2 (from 2.9 on) and 3: one header for both, so that nothing else asks for the version.
//
// This room holds all that differs between the versions. A file here is a header of a few types, or two sources of
// which one is empty. Whoever includes a header of Fast DDS 2 elsewhere (fastrtps/…) does not compile with 3.
#pragma once

#if __has_include(<fastdds/config.hpp>)
#include <fastdds/config.hpp>
#define RMW_FASTDDS_MAJOR FASTDDS_VERSION_MAJOR
#define RMW_FASTDDS_MINOR FASTDDS_VERSION_MINOR
#else
#include <fastrtps/config.h>
#define RMW_FASTDDS_MAJOR FASTRTPS_VERSION_MAJOR
#define RMW_FASTDDS_MINOR FASTRTPS_VERSION_MINOR
#endif

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/dds/core/ReturnCode.hpp>
#include <fastdds/dds/core/Time_t.hpp>
#else
#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/common/Time_t.h>
#include <fastrtps/types/TypesBase.h>
#endif

namespace eprosima::fastdds {
namespace dds {}
namespace rtps {}
}  // namespace eprosima::fastdds
namespace eprosima::fastrtps::rtps {}

namespace rmw_fastrtps {

namespace fdds = eprosima::fastdds::dds;

#if RMW_FASTDDS_MAJOR >= 3

namespace rtps = eprosima::fastdds::rtps;

using DdsDuration = fdds::Duration_t;
inline const DdsDuration kInfiniteDuration = fdds::c_TimeInfinite;

using ReturnCode = fdds::ReturnCode_t;
namespace return_code {
inline constexpr auto kOk = fdds::RETCODE_OK;
inline constexpr auto kNoData = fdds::RETCODE_NO_DATA;
inline constexpr auto kTimeout = fdds::RETCODE_TIMEOUT;
}  // namespace return_code

#else

// Types of the wire are in one namespace, those of transports in the other. Clang asks for a choice where one names a
// class and the other an alias of it.
namespace rtps {
using namespace eprosima::fastdds::rtps;
using namespace eprosima::fastrtps::rtps;
using eprosima::fastdds::rtps::Locators;
using eprosima::fastdds::rtps::LocatorsIterator;
}  // namespace rtps

using DdsDuration = eprosima::fastrtps::Duration_t;
inline const DdsDuration kInfiniteDuration = eprosima::fastrtps::c_TimeInfinite;

using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;
namespace return_code {
inline constexpr auto kOk = ReturnCode::RETCODE_OK;
inline constexpr auto kNoData = ReturnCode::RETCODE_NO_DATA;
inline constexpr auto kTimeout = ReturnCode::RETCODE_TIMEOUT;
}  // namespace return_code

#endif

}  // namespace rmw_fastrtps
