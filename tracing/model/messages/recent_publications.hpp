// SPDX-License-Identifier: Apache-2.0
// The newest publications of a topic, found by their source timestamps. They are in a ring, mostly in the order of
// these, and then found by it. From the first one on that is out of order, a table has their positions in the ring.
// Adding and finding touch few lines of memory, and nothing is allocated once the ring is full.
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
  bool is_estimated = false;  // its timestamp was found when it was taken
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
    if (is_ordered_) {
      return find_in_order(source_timestamp);
    }
    const std::uint32_t position = slots_[slot_of(source_timestamp)].position;
    return position == kEmpty ? nullptr : &ring_[position];
  }

  // Replaces one with the same timestamp. When the ring is full, calls forget(RecentPublication) for the oldest one.
  template <class Forget>
  void add(const RecentPublication& added, Forget forget) {
    const bool is_newest = is_ordered_ && (ring_.empty() || ring_[newest_].source_timestamp < added.source_timestamp);
    if (!is_newest) {
      if (RecentPublication* const same = find(added.source_timestamp)) {
        *same = added;
        return;
      }
      if (is_ordered_) {
        is_ordered_ = false;
        make_slots();
      }
    }
    if (ring_.size() < most_) {
      newest_ = ring_.size();
      ring_.push_back(added);
      if (!is_ordered_ && 2 * ring_.size() > slots_.size()) {
        return make_slots();
      }
    } else {
      newest_ = after_in_ring(newest_);
      // The next one has been in no cache for long.
      __builtin_prefetch(&ring_[after_in_ring(newest_)], 1);
      forget(ring_[newest_]);
      if (!is_ordered_) {
        empty_slot(slot_of(ring_[newest_].source_timestamp));
      }
      ring_[newest_] = added;
    }
    if (!is_ordered_) {
      slots_[slot_of(added.source_timestamp)] = {static_cast<std::uint32_t>(newest_), mixed(added.source_timestamp)};
    }
  }

  // In no particular order.
  const std::vector<RecentPublication>& all() const { return ring_; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffff;

  // The upper bits of a hash. A slot has them, too, so that a search looks at hardly any other publication.
  static std::uint32_t mixed(std::int64_t source_timestamp) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(source_timestamp) * 0x9e3779b97f4a7c15 >> 32);
  }
  // The slot that has the timestamp, or the empty one where it would be.
  std::size_t slot_of(std::int64_t source_timestamp) const {
    const std::uint32_t wanted = mixed(source_timestamp);
    std::size_t slot = wanted & (slots_.size() - 1);
    while (slots_[slot].position != kEmpty &&
           (slots_[slot].mixed != wanted || ring_[slots_[slot].position].source_timestamp != source_timestamp)) {
      slot = after(slot);
    }
    return slot;
  }
  std::size_t after(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  std::size_t after_in_ring(std::size_t position) const { return position + 1 == most_ ? 0 : position + 1; }
  RecentPublication* find_in_order(std::int64_t source_timestamp);
  void empty_slot(std::size_t slot);
  void make_slots();

  std::size_t most_;
  std::size_t newest_ = 0;
  std::vector<RecentPublication> ring_;
  bool is_ordered_ = true;
  struct Slot {
    std::uint32_t position = kEmpty;  // in the ring
    std::uint32_t mixed = 0;          // of its timestamp
  };
  std::vector<Slot> slots_;  // a power of two of them, at least half of them empty
};

}  // namespace tracing
