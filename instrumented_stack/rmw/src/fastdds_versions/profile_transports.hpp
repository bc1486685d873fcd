// SPDX-License-Identifier: Apache-2.0
// The transports that a profile of Fast DDS has chosen.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "fastdds_versions/names.hpp"

namespace rmw_fastrtps {

// Puts a ForwardingTransport before the shared memory of a profile, and before UDP where announcements need it.
void forward_shared_memory(fdds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
