// SPDX-License-Identifier: Apache-2.0
// Finds objects by process and handle. Two processes may use the same handle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "tracing/model/objects/objects.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

struct HandleKey {
  ProcessId process;
  ros2::Handle handle;
  bool operator==(const HandleKey&) const = default;
};

// A table with open addressing: nearly each event looks for an object, which takes one line of memory.
template <class Found>
class HandleIndex {
 public:
  // Null when it is not there. Valid until it is erased.
  const Found* find(const HandleKey& key) const {
    if (slots_.empty()) {
      return nullptr;
    }
    const Slot& slot = slots_[slot_of(key)];
    return slot.place == kEmpty ? nullptr : &found_[slot.place];
  }
  Found* find(const HandleKey& key) { return const_cast<Found*>(std::as_const(*this).find(key)); }

  // Makes one when none is known.
  Found& operator[](const HandleKey& key) {
    if (2 * (count_ + 1) > slots_.size()) {
      grow();
    }
    Slot& slot = slots_[slot_of(key)];
    if (slot.place == kEmpty) {
      ++count_;
      slot = {key.handle, key.process, static_cast<std::uint32_t>(found_.size())};
      if (free_.empty()) {
        found_.emplace_back();
      } else {
        slot.place = free_.back();
        free_.pop_back();
        found_[slot.place] = Found();
      }
    }
    return found_[slot.place];
  }

  void erase(const HandleKey& key) {
    if (slots_.empty()) {
      return;
    }
    std::size_t hole = slot_of(key);
    if (slots_[hole].place == kEmpty) {
      return;
    }
    free_.push_back(slots_[hole].place);
    --count_;
    // What stands behind the slot may have been put there because the slot was taken, and must still be found.
    for (std::size_t next = after(hole); slots_[next].place != kEmpty; next = after(next)) {
      const std::size_t home = home_of({slots_[next].process, slots_[next].handle});
      if (((next - home) & mask()) >= ((next - hole) & mask())) {
        slots_[hole] = slots_[next];
        hole = next;
      }
    }
    slots_[hole] = {};
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  struct Slot {
    ros2::Handle handle = 0;
    ProcessId process = kNoProcess;
    std::uint32_t place = kEmpty;  // in found_
  };

  std::size_t mask() const { return slots_.size() - 1; }
  std::size_t after(std::size_t slot) const { return (slot + 1) & mask(); }
  // Handles differ in their middle bits, processes in the low ones: multiplication spreads both over the word.
  std::size_t home_of(const HandleKey& key) const {
    const std::uint64_t mixed = (key.handle ^ (static_cast<std::uint64_t>(key.process) << 48)) * 0x9e3779b97f4a7c15;
    return (mixed ^ (mixed >> 32)) & mask();
  }
  // The slot that has the key, or the empty one where it would be.
  std::size_t slot_of(const HandleKey& key) const {
    std::size_t slot = home_of(key);
    while (slots_[slot].place != kEmpty && (slots_[slot].handle != key.handle || slots_[slot].process != key.process)) {
      slot = after(slot);
    }
    return slot;
  }
  void grow() {
    std::vector<Slot> smaller(std::max<std::size_t>(8, 2 * slots_.size()));
    smaller.swap(slots_);
    for (const Slot& slot : smaller) {
      if (slot.place != kEmpty) {
        slots_[slot_of({slot.process, slot.handle})] = slot;
      }
    }
  }

  std::vector<Slot> slots_;  // a power of two of them, at least half of them empty
  std::deque<Found> found_;  // does not move what it holds
  std::vector<std::uint32_t> free_;
  std::size_t count_ = 0;
};

// An object that a process does not have is looked for in the process that had its id before (ProcessObject::earlier).
class EarlierProcesses {
 public:
  void learn(const ProcessTable& processes) {
    while (earlier_.size() < processes.processes().size()) {
      earlier_.push_back(processes.processes()[earlier_.size()].earlier);
    }
  }
  // Null when neither has the handle.
  template <class Found>
  const Found* find(const HandleIndex<Found>& index, ProcessId process, ros2::Handle handle) const {
    for (; process != kNoProcess; process = process < earlier_.size() ? earlier_[process] : kNoProcess) {
      if (const Found* const found = index.find({process, handle})) {
        return found;
      }
    }
    return nullptr;
  }

 private:
  std::vector<ProcessId> earlier_;  // by process
};

}  // namespace tracing
