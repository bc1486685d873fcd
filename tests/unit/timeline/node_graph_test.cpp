// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/node_graph.hpp"

#include <gtest/gtest.h>

#include "tests/support/traced_example/traced_example.hpp"

namespace tracing::timeline {
namespace {

TEST(NodeGraph, CountsTheMessagesOfEachEdge) {
  const Timeline timeline = testing::traced_example(100).timeline;
  const std::vector<GraphEdge> graph = node_graph(timeline);
  std::vector<std::string> edges;
  for (const GraphEdge& edge : graph) {
    const std::string ends[] = {timeline.nodes[edge.node].name, timeline.topics[edge.topic]};
    edges.push_back(ends[edge.publishes ? 0 : 1] + " " + ends[edge.publishes ? 1 : 0] + " " +
                    std::to_string(edge.messages) + " " + std::to_string(edge.latency.count));
  }
  EXPECT_EQ(edges, (std::vector<std::string>{"/sensor /scan 100 0", "/scan /filter 100 100", "/filter /points 100 0",
                                             "/points /display 98 98"}));
  EXPECT_EQ(graph[1].latency.p50_ns, 200'000);
}

TEST(NodeGraph, HasEdgesWithoutMessages) {
  Timeline timeline;
  timeline.nodes = {{0, "/a"}};
  timeline.topics = {"/quiet"};
  timeline.publishers = {{0, 0}};
  ASSERT_EQ(node_graph(timeline).size(), 1u);
  EXPECT_EQ(node_graph(timeline)[0].messages, 0u);
}

TEST(NodeGraph, TellsARate) {
  Timeline timeline;
  timeline.begin_ns = 1'000'000'000;
  timeline.end_ns = 3'000'000'000;
  EXPECT_EQ(messages_per_second(timeline, 20), 10.0);
  EXPECT_EQ(messages_per_second(timeline, 1), 0.0) << "one message is no rate";
  timeline.end_ns = timeline.begin_ns;
  EXPECT_EQ(messages_per_second(timeline, 20), 0.0);
}

}  // namespace
}  // namespace tracing::timeline
