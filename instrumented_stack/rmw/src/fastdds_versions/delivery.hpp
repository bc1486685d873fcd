// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "fastdds_versions/names.hpp"

#if RMW_FASTDDS_MAJOR < 3
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif

namespace rmw_fastrtps {

// From now on, participants of one process exchange bytes as participants of several do.
inline void turn_off_delivery_within_the_process() {
#if RMW_FASTDDS_MAJOR >= 3
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  (void)fdds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#else
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#endif
}

}  // namespace rmw_fastrtps
