// SPDX-License-Identifier: Apache-2.0
// What is known of each thread. Consecutive events often come from a few threads, so those that were asked for last are
// found without a search.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

template <class State>
class ThreadMap {
 public:
  State& operator[](const ThreadId& thread) {
    Recent& recent = recent_of(thread);
    if (recent.state == nullptr || !(recent.id == thread)) {
      recent = {thread, &states_[thread]};
    }
    return *recent.state;
  }
  // Null when nothing is known.
  State* find(const ThreadId& thread) {
    Recent& recent = recent_of(thread);
    if (recent.state != nullptr && recent.id == thread) {
      return recent.state;
    }
    const auto found = states_.find(thread);
    if (found == states_.end()) {
      return nullptr;
    }
    recent = {thread, &found->second};
    return recent.state;
  }
  void clear() {
    states_.clear();
    recent_ = {};
  }

  auto begin() { return states_.begin(); }
  auto end() { return states_.end(); }
  auto begin() const { return states_.begin(); }
  auto end() const { return states_.end(); }

 private:
  static constexpr std::size_t kBits = 5;
  struct Recent {
    ThreadId id;
    State* state = nullptr;
  };
  Recent& recent_of(const ThreadId& thread) { return recent_[HashThreadId()(thread) >> (64 - kBits)]; }

  std::unordered_map<ThreadId, State, HashThreadId> states_;  // does not move what it holds
  std::array<Recent, std::size_t{1} << kBits> recent_;        // by the upper bits of their hashes
};

}  // namespace tracing
