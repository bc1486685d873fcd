// SPDX-License-Identifier: Apache-2.0
// GUIDs, locators and what a write takes along.
#pragma once

#include "fastdds_versions/names.hpp"

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/rtps/common/Guid.hpp>
#include <fastdds/rtps/common/InstanceHandle.hpp>
#include <fastdds/rtps/common/Locator.hpp>
#include <fastdds/rtps/common/LocatorList.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/common/WriteParams.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/rtps/common/LocatorList.hpp>
#endif
