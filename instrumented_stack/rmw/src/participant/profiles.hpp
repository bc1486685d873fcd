// SPDX-License-Identifier: Apache-2.0
// The files of profiles that the environment names.
#pragma once

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "fastdds_versions/names.hpp"

namespace rmw_fastrtps {

// Fast DDS 2 reads FASTRTPS_DEFAULT_PROFILES_FILE, Fast DDS 3 FASTDDS_DEFAULT_PROFILES_FILE. Here both have their
// effect. A file that can't be read is an error of the log.
void load_profiles(fdds::DomainParticipantFactory& factory);

}  // namespace rmw_fastrtps
