// SPDX-License-Identifier: Apache-2.0
// Recognises events of provider `ros2_ext` whose first field is the handle of their object.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing::ros2 {

// For the events of one reader. A `Decoded` has a `kind`, a `handle`, and kKinds: pairs of an event's name and its
// kind.
template <typename Decoded>
class HandleEventDecoder {
 public:
  // Returns nothing for another event.
  std::optional<Decoded> decode(const Event& event) {
    const std::size_t id = event.event_class->id;
    if (id >= kinds_.size()) {
      kinds_.resize(id + 1);
    }
    if (!kinds_[id]) {
      kinds_[id] = kind_of(event);
    }
    const Kind& kind = *kinds_[id];
    if (!kind || event.event_class->fields.empty()) {
      return std::nullopt;
    }
    const std::optional<std::uint64_t> handle = event.field(0).unsigned_integer();
    if (!handle) {
      return std::nullopt;
    }
    return Decoded{*kind, *handle};
  }

 private:
  using Kind = std::optional<typename Decoded::Kind>;

  static Kind kind_of(const Event& event) {
    const auto found = std::find_if(Decoded::kKinds.begin(), Decoded::kKinds.end(),
                                    [&](const auto& entry) { return entry.first == event.name(); });
    return found == Decoded::kKinds.end() ? std::nullopt : Kind(found->second);
  }

  std::vector<std::optional<Kind>> kinds_;  // by EventClass::id, as far as they were needed
};

}  // namespace tracing::ros2
