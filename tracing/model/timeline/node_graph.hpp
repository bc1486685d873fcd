// SPDX-License-Identifier: Apache-2.0
// The graph of nodes and topics, with the messages on each edge.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

// A node publishes or receives on a topic.
struct GraphEdge {
  Index node = kNone;
  Index topic = kNone;
  bool publishes = false;
  std::uint64_t messages = 0;  // published, or taken
  DurationSummary latency;     // of what the node received: from rmw_publish to the start of the callback
};

// One edge for each pair of node and topic and each direction, by node and topic. Edges without messages are included.
std::vector<GraphEdge> node_graph(const Timeline& timeline);

// How the traced time is expressed as a rate; 0 for a trace of less than two messages.
double messages_per_second(const Timeline& timeline, std::uint64_t messages);

}  // namespace tracing::timeline
