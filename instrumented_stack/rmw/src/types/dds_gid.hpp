// SPDX-License-Identifier: Apache-2.0
// Converts between the GUID of Fast DDS and ours.
#pragma once

#include <algorithm>

#include "fastdds_versions/guid.hpp"
#include "types/gid.hpp"

namespace rmw_fastrtps {

inline Gid to_gid(const rtps::GUID_t& guid) {
  Gid gid;
  const auto end = std::copy(std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value), gid.begin());
  std::copy(std::begin(guid.entityId.value), std::end(guid.entityId.value), end);
  return gid;
}

inline rtps::GUID_t to_guid(const Gid& gid) {
  rtps::GUID_t guid;
  constexpr auto kPrefixSize = sizeof(guid.guidPrefix.value);
  std::copy(gid.begin(), gid.begin() + kPrefixSize, std::begin(guid.guidPrefix.value));
  std::copy(gid.begin() + kPrefixSize, gid.end(), std::begin(guid.entityId.value));
  return guid;
}

}  // namespace rmw_fastrtps
