// SPDX-License-Identifier: Apache-2.0
// Which nodes the system has and what they listen to: that of the Autoware reference system of the ROS 2 real-time
// working group. A node publishes on the topic of its own name.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace reference_system {

enum class Kind {
  Sensor,        // publishes periodically
  Transform,     // publishes for each message of its input
  Fusion,        // publishes when each of its inputs has brought a new message
  Cyclic,        // publishes periodically what its inputs have brought last
  Intersection,  // passes each input on to an output of its own
  Command,       // the end: tells how long messages took
};

struct NodeDescription {
  std::string name;
  Kind kind;
  std::vector<std::string> inputs;      // topics
  std::vector<std::string> outputs;     // topics
  std::chrono::milliseconds period{0};  // of sensors and cyclic nodes
};

const std::vector<NodeDescription>& graph();

// Throws std::invalid_argument with the names there are.
const NodeDescription& find(const std::string& name);

// The nodes that a message on this topic can have come through.
std::set<std::string> nodes_before(const std::string& topic);

}  // namespace reference_system
