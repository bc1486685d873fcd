// SPDX-License-Identifier: Apache-2.0
// Finds objects by process and handle. Two processes may use the same handle.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tracing/model/objects/objects.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

struct HandleKey {
  ProcessId process;
  ros2::Handle handle;
  bool operator==(const HandleKey&) const = default;
};

struct HashHandleKey {
  // Handles differ in their middle bits, processes in the low ones: multiplication spreads both over the word.
  std::size_t operator()(const HandleKey& key) const {
    const std::uint64_t mixed = (key.handle ^ (static_cast<std::uint64_t>(key.process) << 48)) * 0x9e3779b97f4a7c15;
    return mixed ^ (mixed >> 32);
  }
};

template <class Found>
using HandleIndex = std::unordered_map<HandleKey, Found, HashHandleKey>;

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
      if (const auto found = index.find({process, handle}); found != index.end()) {
        return &found->second;
      }
    }
    return nullptr;
  }

 private:
  std::vector<ProcessId> earlier_;  // by process
};

}  // namespace tracing
