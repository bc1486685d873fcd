// SPDX-License-Identifier: Apache-2.0
// Recognises dds:write, which middleware with its own tracepoints records (patched Cyclone DDS and Fast DDS).
#pragma once

#include <cstdint>
#include <optional>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

class WriteDecoder {
 public:
  // The source timestamp of the message; nullopt for another event.
  std::optional<std::int64_t> decode(const Event& event) {
    const std::optional<std::size_t>& timestamp = timestamps_.of(*event.event_class, [&] {
      return event.event_class->name == "dds:write" ? event.event_class->index_of("timestamp") : std::nullopt;
    });
    return timestamp ? event.field(*timestamp).integer() : std::nullopt;
  }

 private:
  ByEventClass<std::optional<std::size_t>> timestamps_;
};

}  // namespace tracing
