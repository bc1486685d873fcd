// SPDX-License-Identifier: Apache-2.0
// The way that messages have come, which they carry with them, and what can be read from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <reference_interfaces/msg/message4kb.hpp>
#include <string>

namespace reference_system {

using Message = reference_interfaces::msg::Message4kb;

// Copies the nodes that `from` has come through to `to`, without those that `to` has already, as far as there is room.
void merge_history(const Message& from, Message& to);

// Enters the node as the last one, sending now.
void sign(const std::string& node_name, uint32_t sequence_number, uint32_t dropped_samples, Message& message);

// How many nodes the message has come through.
size_t number_of_nodes(const Message& message);

// How long messages took from the nodes that they came through.
class TravelTimes {
 public:
  void add(const Message& message);

  struct Time {
    uint64_t count = 0;
    int64_t min_ns = 0;
    int64_t max_ns = 0;
    double sum_ns = 0;
    uint32_t dropped = 0;  // by the next node, so far
  };
  const std::map<std::string, Time>& times() const { return times_; }

 private:
  std::map<std::string, Time> times_;
};

// The monotonic clock, ns.
int64_t now();

}  // namespace reference_system
