// SPDX-License-Identifier: Apache-2.0
// The nodes of the system and their inputs: the graph of the Autoware reference system of the ROS 2 real-time working
// group. A node publishes on the topic with its own name.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace reference_system {

enum class Kind {
  Sensor,        // publishes periodically
  Transform,     // publishes for each message of its input
  Fusion,        // publishes when each of its inputs has received a new message
  Cyclic,        // publishes the last messages of its inputs periodically
  Intersection,  // passes each input on to its own output
  Command,       // the end: reports how long messages took
};

struct NodeDescription {
  std::string name;
  Kind kind;
  std::vector<std::string> inputs;      // topics
  std::vector<std::string> outputs;     // topics
  std::chrono::milliseconds period{0};  // for sensors and cyclic nodes
};

const std::vector<NodeDescription>& graph();

// Throws std::invalid_argument with the known names.
const NodeDescription& find(const std::string& name);

// The nodes that a message on this topic may have passed.
std::set<std::string> nodes_before(const std::string& topic);

}  // namespace reference_system
