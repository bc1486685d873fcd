// From the GUID of Fast DDS to ours.
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <algorithm>

#include "gid.hpp"

namespace rmw_fastrtps {

inline Gid to_gid(const eprosima::fastrtps::rtps::GUID_t& guid) {
  Gid gid;
  const auto end = std::copy(std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value), gid.begin());
  std::copy(std::begin(guid.entityId.value), std::end(guid.entityId.value), end);
  return gid;
}

}  // namespace rmw_fastrtps
