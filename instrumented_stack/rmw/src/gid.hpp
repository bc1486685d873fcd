// Identity of an endpoint or participant: the bytes of its DDS GUID.
#pragma once

#include <array>
#include <cstdint>

#include "rmw/types.h"

namespace rmw_fastrtps {

using Gid = std::array<std::uint8_t, RMW_GID_STORAGE_SIZE>;

}  // namespace rmw_fastrtps
