// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/node_graph.hpp"

#include <map>
#include <tuple>

namespace tracing::timeline {

std::vector<GraphEdge> node_graph(const Timeline& timeline) {
  struct Traffic {
    std::uint64_t messages = 0;
    DurationStatistics latency;
  };
  using Key = std::tuple<Index, Index, bool>;
  std::map<Key, Traffic> edges;
  const auto edge = [&edges](const Endpoint& end, bool publishes) -> Traffic& {
    return edges[Key{end.node, end.topic, !publishes}];
  };
  for (const Endpoint& publisher : timeline.publishers) {
    edge(publisher, true);
  }
  for (const Endpoint& subscription : timeline.subscriptions) {
    edge(subscription, false);
  }
  for (const Message& message : timeline.messages) {
    if (!message.repeated && message.publisher != kNone) {
      ++edge(timeline.publishers[message.publisher], true).messages;
    }
    if (message.subscription == kNone) {
      continue;
    }
    Traffic& received = edge(timeline.subscriptions[message.subscription], false);
    ++received.messages;
    if (message.receiving_instance != kNone) {
      received.latency.add(timeline.instances[message.receiving_instance].start_ns - message.published_ns);
    }
  }
  std::vector<GraphEdge> graph;
  for (const auto& [key, traffic] : edges) {
    const auto& [node, topic, receives] = key;
    if (node == kNone) {
      continue;
    }
    graph.push_back({node, topic, !receives, traffic.messages, traffic.latency.summary()});
  }
  return graph;
}

double messages_per_second(const Timeline& timeline, std::uint64_t messages) {
  const std::int64_t duration = timeline.end_ns - timeline.begin_ns;
  return duration <= 0 || messages < 2 ? 0 : static_cast<double>(messages) * 1e9 / static_cast<double>(duration);
}

}  // namespace tracing::timeline
