// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/recent_publications.hpp"

#include <algorithm>

namespace tracing {

// What stands behind the slot may have been put there because the slot was taken, and must still be found.
void RecentPublications::empty_slot(std::size_t slot) {
  for (std::size_t next = after(slot); slots_[next] != kEmpty; next = after(next)) {
    const std::size_t home = home_of(ring_[slots_[next]].source_timestamp);
    const std::size_t mask = slots_.size() - 1;
    if (((next - home) & mask) >= ((next - slot) & mask)) {
      slots_[slot] = slots_[next];
      slot = next;
    }
  }
  slots_[slot] = kEmpty;
}

void RecentPublications::make_slots() {
  slots_.assign(std::max<std::size_t>(8, 2 * slots_.size()), kEmpty);
  for (std::size_t position = 0; position < ring_.size(); ++position) {
    slots_[slot_of(ring_[position].source_timestamp)] = static_cast<std::uint32_t>(position);
  }
}

}  // namespace tracing
