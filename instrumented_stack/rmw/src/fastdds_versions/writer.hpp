// SPDX-License-Identifier: Apache-2.0
// Writes and the settings of writers.
#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>

#include "fastdds_versions/guid.hpp"

namespace rmw_fastrtps {

// Whether the sample was written. `params` get its identity.
[[gnu::hot]] inline bool write_sample(fdds::DataWriter& writer, void* data, rtps::WriteParams& params) {
#if RMW_FASTDDS_MAJOR >= 3
  return writer.write(data, params) == return_code::kOk;
#else
  return writer.write(data, params);
#endif
}

inline DdsDuration& heartbeat_period(fdds::DataWriterQos& qos) {
#if RMW_FASTDDS_MAJOR >= 3
  return qos.reliable_writer_qos().times.heartbeat_period;
#else
  return qos.reliable_writer_qos().times.heartbeatPeriod;
#endif
}

}  // namespace rmw_fastrtps
