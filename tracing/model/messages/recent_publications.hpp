// SPDX-License-Identifier: Apache-2.0
// The newest publications of a topic, found by their source timestamps. A table of positions in a ring: adding and
// finding touch few lines of memory, and nothing is allocated once the ring is full.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

struct RecentPublication {
  std::int64_t source_timestamp = 0;
  Publication publication;
  bool received = false;
};

class RecentPublications {
 public:
  explicit RecentPublications(std::size_t most) : most_(most) {}

  // Null when it is not there. Valid until the next add().
  RecentPublication* find(std::int64_t source_timestamp) {
    if (ring_.empty()) {
      return nullptr;
    }
    if (ring_[newest_].source_timestamp == source_timestamp) {
      return &ring_[newest_];
    }
    const std::uint32_t position = slots_[slot_of(source_timestamp)];
    return position == kEmpty ? nullptr : &ring_[position];
  }

  // Replaces one with the same timestamp. When the ring is full, calls forget(RecentPublication) for the oldest one.
  template <class Forget>
  void add(const RecentPublication& added, Forget forget) {
    if (RecentPublication* const same = find(added.source_timestamp)) {
      *same = added;
      return;
    }
    if (ring_.size() < most_) {
      newest_ = ring_.size();
      ring_.push_back(added);
      if (2 * ring_.size() > slots_.size()) {
        return make_slots();
      }
    } else {
      newest_ = (newest_ + 1) % most_;
      forget(ring_[newest_]);
      empty_slot(slot_of(ring_[newest_].source_timestamp));
      ring_[newest_] = added;
    }
    slots_[slot_of(added.source_timestamp)] = static_cast<std::uint32_t>(newest_);
  }

  // In no particular order.
  const std::vector<RecentPublication>& all() const { return ring_; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffff;

  std::size_t home_of(std::int64_t source_timestamp) const {
    const std::uint64_t mixed = static_cast<std::uint64_t>(source_timestamp) * 0x9e3779b97f4a7c15;
    return (mixed >> 32) & (slots_.size() - 1);
  }
  // The slot that has the timestamp, or the empty one where it would be.
  std::size_t slot_of(std::int64_t source_timestamp) const {
    std::size_t slot = home_of(source_timestamp);
    while (slots_[slot] != kEmpty && ring_[slots_[slot]].source_timestamp != source_timestamp) {
      slot = after(slot);
    }
    return slot;
  }
  std::size_t after(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  void empty_slot(std::size_t slot);
  void make_slots();

  std::size_t most_;
  std::size_t newest_ = 0;
  std::vector<RecentPublication> ring_;
  std::vector<std::uint32_t> slots_;  // positions in the ring; a power of two of them, at least half of them empty
};

}  // namespace tracing
