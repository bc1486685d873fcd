// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/graph/graph.hpp"

namespace launch {

namespace {

std::string as_id(std::string_view text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '\n') {
      result += "\\n";
      continue;
    }
    if (character == '"' || character == '\\') {
      result += '\\';
    }
    result += character;
  }
  return result + "\"";
}

std::string label_of(const LaunchGraph::Box& box) {
  std::string label;
  for (const std::string& line : box.lines) {
    label += (label.empty() ? "" : "\n") + line;
  }
  return as_id(label);
}

std::string_view style_of(const LaunchGraph::Box& box) {
  return box.left_out ? "style=dashed, color=gray, fontcolor=gray, " : "";
}

std::string edge_style(const LaunchGraph::Edge& edge) {
  switch (edge.relation) {
    case LaunchGraph::Relation::kIncludes:
      return "color=gray, label=\"includes\"";
    case LaunchGraph::Relation::kAsksFor:
      return "color=gray";
    case LaunchGraph::Relation::kLoads:
      return "style=dotted, label=\"loads\"";
    case LaunchGraph::Relation::kRemaps:
      return fmt::format("dir=none, color=blue, label={}", as_id(edge.label));
    case LaunchGraph::Relation::kWaitsFor:
      return fmt::format("style=dashed, label={}", as_id(edge.label));
    case LaunchGraph::Relation::kHandles:
      return "color=orange";
    case LaunchGraph::Relation::kStarts:
      return fmt::format("color=orange, label={}", as_id(edge.label));
  }
  return "";
}

// The nodes in their namespaces, and the other processes, of one machine. `number` is that of the next cluster.
std::string boxes_of(const LaunchGraph& graph, const std::string& machine, std::size_t& number) {
  std::string text;
  for (const auto& [name_space, nodes] : graph.nodes) {
    std::string lines;
    for (const LaunchGraph::Box& node : nodes) {
      if (node.machine == machine) {
        lines += fmt::format("  {} [{}label={}];\n", as_id(node.id), style_of(node), label_of(node));
      }
    }
    text += name_space == "/" || lines.empty()
                ? lines
                : fmt::format("  subgraph cluster_{} {{\n  label={};\n{}  }}\n", number++, as_id(name_space), lines);
  }
  for (const LaunchGraph::Box& process : graph.processes) {
    if (process.machine == machine) {
      text += fmt::format("  {} [shape=box, {}label={}];\n", as_id(process.id), style_of(process), label_of(process));
    }
  }
  return text;
}

}  // namespace

std::string graph_as_dot(const LaunchGraph& graph) {
  std::string text =
      "digraph launch {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\"];\n";
  for (const auto& [path, file] : graph.files) {
    text += fmt::format("  {} [shape=note, color=gray, label={}];\n", as_id(file.id), label_of(file));
  }
  std::size_t number = 0;
  const std::vector<std::string> machines = graph.machines();
  const bool framed = machines.size() > 1 || (!machines.empty() && !machines.front().empty());
  for (const std::string& machine : machines) {
    const std::string inside = boxes_of(graph, machine, number);
    text += framed ? fmt::format("  subgraph cluster_{} {{\n  label={};\n  style=rounded;\n{}  }}\n", number++,
                                 as_id(title_of_machine(machine)), inside)
                   : inside;
  }
  for (const LaunchGraph::Box& handler : graph.handlers) {
    text += fmt::format("  {} [shape=cds, color=orange, label={}];\n", as_id(handler.id), label_of(handler));
  }
  for (const LaunchGraph::Box& topic : graph.topics) {
    text += fmt::format("  {} [shape=plaintext, label={}];\n", as_id(topic.id), label_of(topic));
  }
  for (const LaunchGraph::Edge& edge : graph.edges) {
    text += fmt::format("  {} -> {} [{}];\n", as_id(edge.from), as_id(edge.to), edge_style(edge));
  }
  return text + "}\n";
}

}  // namespace launch
