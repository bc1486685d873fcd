// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "tracing/model/timeline/node_graph.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {

namespace {

std::string dot_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

std::string milliseconds(std::int64_t nanoseconds) {
  return fmt::format("{:.3g} ms", static_cast<double>(nanoseconds) / 1e6);
}

std::string label_of(const timeline::GraphEdge& edge, const timeline::Timeline& timeline) {
  if (edge.messages == 0) {
    return "none";
  }
  const double rate = timeline::messages_per_second(timeline, edge.messages);
  std::string label = rate == 0 ? fmt::format("{}", edge.messages) : fmt::format("{:.3g} Hz", rate);
  if (edge.latency.count > 0) {
    label += fmt::format("\\np50 {}\\np99 {}", milliseconds(edge.latency.p50_ns), milliseconds(edge.latency.p99_ns));
  }
  return label;
}

}  // namespace

std::string dot_text(const TracedSystem& system) {
  const timeline::Timeline& timeline = system.timeline;
  const std::vector<timeline::GraphEdge> edges = timeline::node_graph(timeline);
  std::string text = "// Nodes are ellipses, topics are boxes. Latencies are from rmw_publish to callback_start.\n";
  text +=
      "digraph system {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\", "
      "fontsize=10];\n";
  std::set<timeline::Index> topics;
  for (std::size_t id = 0; id < timeline.nodes.size(); ++id) {
    text += fmt::format("  n{} [label={}];\n", id, dot_string(timeline.nodes[id].name));
  }
  for (const timeline::GraphEdge& edge : edges) {
    topics.insert(edge.topic);
  }
  for (const timeline::Index id : topics) {
    text += fmt::format("  t{} [shape=box, label={}];\n", id, dot_string(timeline.topics[id]));
  }
  for (const timeline::GraphEdge& edge : edges) {
    const std::string ends = edge.publishes ? fmt::format("n{} -> t{}", edge.node, edge.topic)
                                            : fmt::format("t{} -> n{}", edge.topic, edge.node);
    text += fmt::format("  {} [label=\"{}\"];\n", ends, label_of(edge, timeline));
  }
  return text + "}\n";
}

void export_dot(const TracedSystem& system, const std::filesystem::path& path) {
  OutputFile file(path);
  file.write(dot_text(system));
  file.finish();
}

}  // namespace tracing
