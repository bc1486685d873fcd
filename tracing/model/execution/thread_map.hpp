// SPDX-License-Identifier: Apache-2.0
// What is known of each thread. Consecutive events often come from a few threads, so those that were asked for last are
// found without a search.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

template <class State>
class ThreadMap {
 public:
  [[gnu::always_inline]] State& operator[](const ThreadId& thread) {
    const Recent& recent = recent_of(thread);
    return recent.id == thread ? *recent.state : search(thread);
  }
  // Null when nothing is known.
  [[gnu::always_inline]] State* find(const ThreadId& thread) {
    const Recent& recent = recent_of(thread);
    return recent.id == thread ? recent.state : search_known(thread);
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
  static constexpr std::size_t kRecent = 32;
  struct Recent {
    ThreadId id = {kNoProcess, std::numeric_limits<std::int64_t>::min()};  // of no thread
    State* state = nullptr;
  };
  // Threads that are made one after the other have ids one after the other.
  Recent& recent_of(const ThreadId& thread) {
    return recent_[(static_cast<std::size_t>(thread.vtid) + thread.process) % kRecent];
  }
  [[gnu::noinline]] State& search(const ThreadId& thread) {
    State& state = states_[thread];
    recent_of(thread) = {thread, &state};
    return state;
  }
  [[gnu::noinline]] State* search_known(const ThreadId& thread) {
    const auto found = states_.find(thread);
    if (found == states_.end()) {
      return nullptr;
    }
    recent_of(thread) = {thread, &found->second};
    return &found->second;
  }

  std::unordered_map<ThreadId, State, HashThreadId> states_;  // does not move what it holds
  std::array<Recent, kRecent> recent_;
};

}  // namespace tracing
