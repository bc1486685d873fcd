// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"

namespace tracing {
namespace {

TEST(DotExport, WritesNodesTopicsRatesAndLatencies) {
  const testing::TemporaryDirectory directory;
  TracedSystem system = testing::traced_example(100);
  system.timeline.end_ns = system.timeline.begin_ns + 1'000'000'000;
  system.timeline.topics.push_back("/\"odd\"");
  system.timeline.publishers.push_back({0, 2});
  export_dot(system, directory.path() / "graph.dot");
  std::ifstream file(directory.path() / "graph.dot");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
            R"(// Nodes are ellipses, topics are boxes. Latencies are from rmw_publish to callback_start.
digraph system {
  rankdir=LR;
  node [fontname="sans-serif"];
  edge [fontname="sans-serif", fontsize=10];
  n0 [label="/sensor"];
  n1 [label="/filter"];
  n2 [label="/display"];
  t0 [shape=box, label="/scan"];
  t1 [shape=box, label="/points"];
  t2 [shape=box, label="/\"odd\""];
  n0 -> t0 [label="100 Hz"];
  n0 -> t2 [label="none"];
  t0 -> n1 [label="100 Hz\np50 0.2 ms\np99 0.2 ms"];
  n1 -> t1 [label="100 Hz"];
  t1 -> n2 [label="98 Hz\np50 0.2 ms\np99 0.2 ms"];
}
)");
}

}  // namespace
}  // namespace tracing
