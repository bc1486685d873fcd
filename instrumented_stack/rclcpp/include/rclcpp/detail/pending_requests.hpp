// SPDX-License-Identifier: Apache-2.0
// The requests of a client that have no response yet.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace rclcpp::detail {

// Keeps for each request the receiver of its response. Thread safe.
template <typename AnswerT>
class PendingRequests {
 public:
  // Calls `send`, which returns the id of the request.
  template <typename SendT>
  int64_t add(SendT send, AnswerT answer) {
    // Locked until the request is registered, because its response may come before this function returns.
    const std::lock_guard lock(mutex_);
    const int64_t request_id = send();
    requests_.emplace(request_id, Request{std::chrono::system_clock::now(), std::move(answer)});
    return request_id;
  }

  // Empty if the request is not pending.
  std::optional<AnswerT> take(int64_t request_id) {
    const std::lock_guard lock(mutex_);
    auto node = requests_.extract(request_id);
    return node.empty() ? std::nullopt : std::optional<AnswerT>(std::move(node.mapped().answer));
  }

  bool remove(int64_t request_id) {
    const std::lock_guard lock(mutex_);
    return requests_.erase(request_id) != 0;
  }

  // Both return the number of requests that were removed; the second also gets their ids.
  size_t prune() {
    const std::lock_guard lock(mutex_);
    const size_t count = requests_.size();
    requests_.clear();
    return count;
  }
  template <typename AllocatorT>
  size_t prune_older_than(std::chrono::system_clock::time_point time_point,
                          std::vector<int64_t, AllocatorT>* pruned_requests) {
    const std::lock_guard lock(mutex_);
    const size_t before = requests_.size();
    for (auto entry = requests_.begin(); entry != requests_.end();) {
      if (entry->second.sent >= time_point) {
        ++entry;
        continue;
      }
      if (pruned_requests != nullptr) {
        pruned_requests->push_back(entry->first);
      }
      entry = requests_.erase(entry);
    }
    return before - requests_.size();
  }

 private:
  struct Request {
    std::chrono::system_clock::time_point sent;
    AnswerT answer;
  };

  std::mutex mutex_;
  std::map<int64_t, Request> requests_;
};

}  // namespace rclcpp::detail
