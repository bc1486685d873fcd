// SPDX-License-Identifier: Apache-2.0
// A flag that is set when the graph changes: see Node::get_graph_event().
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "rclcpp/macros.hpp"

namespace rclcpp {

namespace exceptions {

class InvalidEventError : public std::runtime_error {
 public:
  InvalidEventError() : std::runtime_error("event is invalid") {}
};

}  // namespace exceptions

// Thread safe.
class Event {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Event)

  // Only set() sets it.
  Event() = default;
  // It is also set if `count` returns a number that differs from the one at construction or at the last
  // check_and_clear(). The functions below call `count`.
  explicit Event(std::function<uint64_t()> count) : count_(std::move(count)), seen_(count_()) {}

  // These return whether it was set before.
  bool set() { return set_.exchange(true) || changed(); }
  bool check() const { return set_ || changed(); }
  bool check_and_clear() {
    const uint64_t number = count_ ? count_() : 0;
    const bool was_set = set_.exchange(false);
    return seen_.exchange(number) != number || was_set;
  }

  // Whether the graph sets it: it comes from get_graph_event().
  bool watches_graph() const { return count_ != nullptr; }

 private:
  bool changed() const { return count_ && count_() != seen_; }

  std::atomic_bool set_{false};
  std::function<uint64_t()> count_;
  std::atomic<uint64_t> seen_{0};
};

}  // namespace rclcpp
