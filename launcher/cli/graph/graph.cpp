// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/graph/graph.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace launch {

namespace {

std::string joined(const std::string& name_space, const std::string& name) {
  const std::string base = name_space.empty() || name_space.front() != '/' ? "/" + name_space : name_space;
  return base == "/" ? "/" + name : base + "/" + name;
}

// The remaps of names in the arguments of a node: `-r from:=to`, without those of its own name and namespace.
std::vector<std::pair<std::string, std::string>> remaps_of(const std::vector<std::string>& argv) {
  std::vector<std::pair<std::string, std::string>> remaps;
  for (std::size_t i = 1; i < argv.size(); ++i) {
    const std::size_t separator = argv[i].find(":=");
    if ((argv[i - 1] == "-r" || argv[i - 1] == "--remap") && separator != std::string::npos &&
        argv[i].find("__n") == std::string::npos) {
      remaps.emplace_back(argv[i].substr(0, separator), argv[i].substr(separator + 2));
    }
  }
  return remaps;
}

class GraphBuilder {
 public:
  using Relation = LaunchGraph::Relation;

  LaunchGraph build(const LaunchPlan& plan) {
    std::set<std::size_t> nodes;
    for (const NodeDescription& node : plan.nodes) {
      nodes.insert(node.process);
      const ProcessSpec& spec = plan.processes[node.process];
      add_node(joined(node.name_space.value_or(""), node.name.value_or(spec.name)), node.name_space.value_or("/"),
               node.package ? fmt::format("{} {}", *node.package, node.executable) : node.executable, spec.origin,
               remaps_of(spec.argv));
    }
    for (std::size_t i = 0; i < plan.processes.size(); ++i) {
      if (!nodes.contains(i)) {
        const std::string id = fmt::format("process {}", graph_.processes.size());
        graph_.processes.push_back({id, {plan.processes[i].name}});
        asked_by(plan.processes[i].origin, id);
      }
    }
    for (const LoadRequest& request : plan.loads) {
      for (const ComposableNode& component : request.nodes) {
        const std::string id = add_node(
            joined(component.name_space, component.name), component.name_space.empty() ? "/" : component.name_space,
            fmt::format("{} in {}", component.plugin, request.target), component.origin, component.remaps);
        const std::string& target = request.target;
        graph_.edges.push_back({target.starts_with('/') ? target : "/" + target, id, Relation::kLoads, "loads"});
      }
    }
    for (const std::string& topic : topics_) {
      graph_.topics.push_back({"topic " + topic, {topic}});
    }
    return std::move(graph_);
  }

 private:
  std::string add_node(const std::string& full_name, std::string name_space, const std::string& program,
                       const SourceRange& origin, const std::vector<std::pair<std::string, std::string>>& remaps) {
    // Several nodes of one name are drawn as several nodes, because a user wants to see that.
    std::string id = full_name;
    for (int again = 2; !ids_.insert(id).second; ++again) {
      id = fmt::format("{} ({})", full_name, again);
    }
    if (name_space.empty() || name_space.front() != '/') {
      name_space = "/" + name_space;
    }
    graph_.nodes[name_space].push_back({id, {full_name, program}});
    asked_by(origin, id);
    for (const auto& [from, to] : remaps) {
      topics_.insert(to);
      graph_.edges.push_back({id, "topic " + to, Relation::kRemaps, from});
    }
    return id;
  }

  void asked_by(const SourceRange& origin, const std::string& id) {
    if (origin) {
      const std::string file = add_file(*origin.file);
      graph_.edges.push_back({file, id, Relation::kAsksFor, ""});
    }
  }

  std::string add_file(const SourceFile& file) {
    const std::string id = "file " + file.path();
    graph_.files.emplace(file.path(), LaunchGraph::Box{id, {std::filesystem::path(file.path()).filename().string()}});
    if (const SourceRange& from = file.included_from(); from) {
      const std::string includer = add_file(*from.file);
      if (includes_.emplace(includer, id).second) {
        graph_.edges.push_back({includer, id, Relation::kIncludes, "includes"});
      }
    }
    return id;
  }

  LaunchGraph graph_;
  std::set<std::string> topics_;
  std::set<std::string> ids_;
  std::set<std::pair<std::string, std::string>> includes_;
};

}  // namespace

LaunchGraph graph_of(const LaunchPlan& plan) {
  return GraphBuilder().build(plan);
}

}  // namespace launch
