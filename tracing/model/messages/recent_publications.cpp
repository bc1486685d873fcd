// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/recent_publications.hpp"

#include <algorithm>
#include <bit>

namespace tracing {

// Whoever is late takes one of the last.
RecentPublication* RecentPublications::find_in_order(std::int64_t source_timestamp) {
  constexpr std::size_t kLast = 8;
  std::size_t position = newest_;
  for (std::size_t i = 0; i < std::min(kLast, ring_.size()); ++i) {
    if (ring_[position].source_timestamp <= source_timestamp) {
      return ring_[position].source_timestamp == source_timestamp ? &ring_[position] : nullptr;
    }
    position = position == 0 ? ring_.size() - 1 : position - 1;
  }
  // Places count from the oldest one.
  const auto at = [this](std::size_t place) -> RecentPublication& {
    return ring_[(newest_ + 1 + place) % ring_.size()];
  };
  std::size_t first = 0;
  std::size_t last = ring_.size();
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    const bool is_before = at(middle).source_timestamp < source_timestamp;
    (is_before ? first : last) = is_before ? middle + 1 : middle;
  }
  return first < ring_.size() && at(first).source_timestamp == source_timestamp ? &at(first) : nullptr;
}

// What stands behind the slot may have been put there because the slot was taken, and must still be found.
void RecentPublications::empty_slot(std::size_t slot) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t next = after(slot); slots_[next].position != kEmpty; next = after(next)) {
    const std::size_t home = slots_[next].mixed & mask;
    if (((next - home) & mask) >= ((next - slot) & mask)) {
      slots_[slot] = slots_[next];
      slot = next;
    }
  }
  slots_[slot] = {};
}

void RecentPublications::make_slots() {
  slots_.assign(std::bit_ceil(std::max<std::size_t>(8, 2 * ring_.size())), {});
  for (std::size_t position = 0; position < ring_.size(); ++position) {
    const std::int64_t source_timestamp = ring_[position].source_timestamp;
    slots_[slot_of(source_timestamp)] = {static_cast<std::uint32_t>(position), mixed(source_timestamp)};
  }
}

}  // namespace tracing
