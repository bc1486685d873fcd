// SPDX-License-Identifier: Apache-2.0
// Times of a trace, as reports print them.
#pragma once

#include <cstdint>

namespace tracing {

inline double to_seconds(std::uint64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e9;
}

}  // namespace tracing
