// SPDX-License-Identifier: Apache-2.0
// The kinds of nodes of the reference system.
#pragma once

#include <cstdint>
#include <memory>
#include <rclcpp/rclcpp.hpp>

#include "graph.hpp"

namespace reference_system {

struct Settings {
  // The amount of work in a callback: it searches the primes up to this number.
  uint64_t number_crunch_limit = 4096;
  bool use_intra_process_comms = false;
  // The process ends when each of its command nodes has received this many messages that passed all nodes before it; 0:
  // never.
  uint64_t messages = 0;
};

// Creates the node, ready for an executor.
std::shared_ptr<rclcpp::Node> create_node(const NodeDescription& description, const Settings& settings);

}  // namespace reference_system
