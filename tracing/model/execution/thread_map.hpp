// SPDX-License-Identifier: Apache-2.0
// What is known of each thread. Consecutive events often come from one thread, so the last one is found without a
// search.
#pragma once

#include <unordered_map>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

template <class State>
class ThreadMap {
 public:
  State& operator[](const ThreadId& thread) {
    if (last_ == nullptr || !(thread == last_id_)) {
      last_ = &states_[thread];
      last_id_ = thread;
    }
    return *last_;
  }
  // Null when nothing is known.
  State* find(const ThreadId& thread) {
    if (last_ != nullptr && thread == last_id_) {
      return last_;
    }
    const auto found = states_.find(thread);
    if (found == states_.end()) {
      return nullptr;
    }
    last_ = &found->second;
    last_id_ = thread;
    return last_;
  }
  void clear() {
    states_.clear();
    last_ = nullptr;
  }

  auto begin() { return states_.begin(); }
  auto end() { return states_.end(); }
  auto begin() const { return states_.begin(); }
  auto end() const { return states_.end(); }

 private:
  std::unordered_map<ThreadId, State, HashThreadId> states_;  // does not move what it holds
  ThreadId last_id_;
  State* last_ = nullptr;
};

}  // namespace tracing
