// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/recent_publications.hpp"

#include <algorithm>

namespace tracing {

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
  slots_.assign(std::max<std::size_t>(8, 2 * slots_.size()), {});
  for (std::size_t position = 0; position < ring_.size(); ++position) {
    const std::int64_t source_timestamp = ring_[position].source_timestamp;
    slots_[slot_of(source_timestamp)] = {static_cast<std::uint32_t>(position), mixed(source_timestamp)};
  }
}

}  // namespace tracing
