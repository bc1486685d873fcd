// SPDX-License-Identifier: Apache-2.0
#include "fastdds_versions/transport.hpp"

#if RMW_FASTDDS_MAJOR < 3
#include <unistd.h>

#include <string>
#endif

namespace rmw_fastrtps {

bool ForwardingTransport::is_reachable([[maybe_unused]] const rtps::Locator& locator) const {
#if RMW_FASTDDS_MAJOR < 3
  if (locator.kind == LOCATOR_KIND_SHM) {
    return access(("/dev/shm/fastrtps_port" + std::to_string(locator.port)).c_str(), F_OK) == 0;
  }
#endif
  return true;
}

}  // namespace rmw_fastrtps
