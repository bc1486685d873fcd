// SPDX-License-Identifier: Apache-2.0
// How many events there are, without the events themselves.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// Valid as long as the reader.
struct EventCounts {
  struct OfClass {
    const EventClass* event_class = nullptr;
    std::uint64_t events = 0;  // at least 1
  };
  std::vector<OfClass> events;
  std::vector<Loss> losses;  // stream by stream
};

}  // namespace tracing
