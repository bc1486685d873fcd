// SPDX-License-Identifier: Apache-2.0
// The kinds of nodes of the reference system.
#pragma once

#include <cstdint>
#include <memory>
#include <rclcpp/rclcpp.hpp>

#include "graph.hpp"

namespace reference_system {

struct Settings {
  // How much work a callback does: it looks for the primes up to this number.
  uint64_t number_crunch_limit = 4096;
  bool use_intra_process_comms = false;
  // The process ends when each of its command nodes has got so many messages that have come through all nodes before
  // it; 0: never.
  uint64_t messages = 0;
};

// The node, ready to be given to an executor.
std::shared_ptr<rclcpp::Node> create_node(const NodeDescription& description, const Settings& settings);

}  // namespace reference_system
