// SPDX-License-Identifier: Apache-2.0
// Recognises the events of lttng-ust's wrapper around the C library that tell of memory that was asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

class AllocationDecoder {
 public:
  // The number of bytes that were asked for; nullopt for another event.
  std::optional<std::uint64_t> decode(const Event& event);

 private:
  struct Plan {
    bool is_allocation = false;
    std::optional<std::size_t> size;   // indices of fields
    std::optional<std::size_t> count;  // of calloc
  };
  static Plan plan_of(const EventClass& event_class);

  std::vector<std::optional<Plan>> plans_;  // by EventClass::id
};

}  // namespace tracing
