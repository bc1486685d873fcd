// SPDX-License-Identifier: Apache-2.0
// The path of a message, which the message carries, and statistics from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <reference_interfaces/msg/message4kb.hpp>
#include <string>

namespace reference_system {

using Message = reference_interfaces::msg::Message4kb;

// Copies the nodes in the history of `from` to `to`, except those that `to` already has, as far as there is room.
void merge_history(const Message& from, Message& to);

// Adds the node as the last one, with the current time as its send time.
void sign(const std::string& node_name, uint32_t sequence_number, uint32_t dropped_samples, Message& message);

// The number of nodes that the message has passed.
size_t number_of_nodes(const Message& message);

// How long messages took from the nodes that they passed.
class TravelTimes {
 public:
  void add(const Message& message);

  struct Time {
    uint64_t count = 0;
    int64_t min_ns = 0;
    int64_t max_ns = 0;
    double sum_ns = 0;
    uint32_t dropped = 0;  // dropped by the next node, so far
  };
  const std::map<std::string, Time>& times() const { return times_; }

 private:
  std::map<std::string, Time> times_;
};

// The monotonic clock, in ns.
int64_t now();

}  // namespace reference_system
