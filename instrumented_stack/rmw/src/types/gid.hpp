// SPDX-License-Identifier: Apache-2.0
// Identity of an endpoint or participant: the bytes of its DDS GUID.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "rmw/types.h"

namespace rmw_fastrtps {

using Gid = std::array<std::uint8_t, RMW_GID_STORAGE_SIZE>;

// The first twelve bytes name the participant.
inline bool same_participant(const Gid& a, const Gid& b) {
  constexpr std::size_t kPrefixLength = 12;
  return std::equal(a.begin(), a.begin() + kPrefixLength, b.begin());
}

}  // namespace rmw_fastrtps
