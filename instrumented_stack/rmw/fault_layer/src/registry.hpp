// SPDX-License-Identifier: Apache-2.0
// The endpoints of this process that have faults, by the addresses by which rmw names them.
#pragma once

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <unordered_map>

#include "faults/message_faults.hpp"
#include "middleware.hpp"

namespace rmw_fault_layer {

// Thread safe.
template <typename State>
class Registry {
 public:
  void add(const void* key, std::shared_ptr<State> state) {
    const std::unique_lock lock(mutex_);
    states_[key] = std::move(state);
  }
  // Returns what was there, so that it ends without the lock.
  std::shared_ptr<State> remove(const void* key) {
    const std::unique_lock lock(mutex_);
    const auto found = states_.find(key);
    if (found == states_.end()) {
      return nullptr;
    }
    std::shared_ptr<State> state = std::move(found->second);
    states_.erase(found);
    return state;
  }
  // Null if there is none.
  std::shared_ptr<State> find(const void* key) const {
    const std::shared_lock lock(mutex_);
    const auto found = states_.find(key);
    return found == states_.end() ? nullptr : found->second;
  }

 private:
  mutable std::shared_mutex mutex_;
  std::unordered_map<const void*, std::shared_ptr<State>> states_;
};

// Null if no fault names the endpoint.
inline std::unique_ptr<rmw_fastrtps::MessageFaults> faults_of(rmw_message_faults::Side side, const char* name,
                                                              const rmw_node_t* node) {
  if (!is_needed()) {
    return nullptr;
  }
  const std::string name_space = node->namespace_;
  return rmw_fastrtps::MessageFaults::of(side, name, name_space + (name_space.ends_with('/') ? "" : "/") + node->name);
}

}  // namespace rmw_fault_layer
