// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/graph/graph.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <variant>

#include "base/overloaded.hpp"
#include "launcher/plan/node_names.hpp"

namespace launch {

namespace {

const char* verb_of(ProcessCommand::Kind kind) {
  switch (kind) {
    case ProcessCommand::Kind::kStop:
      return "stops";
    case ProcessCommand::Kind::kRestart:
      return "restarts";
    case ProcessCommand::Kind::kSignal:
      return "signals";
    case ProcessCommand::Kind::kSetPriority:
      return "sets the priority of";
    case ProcessCommand::Kind::kRestorePriority:
      return "restores the priority of";
  }
  return "";
}

class GraphBuilder {
 public:
  using Relation = LaunchGraph::Relation;

  LaunchGraph build(const LaunchPlan& plan, const std::vector<Requests>& left_out) {
    add_plan(plan, "");
    left_out_ = true;
    for (const Requests& requests : left_out) {
      add_processes(requests.processes, requests.nodes, {});
      std::for_each(requests.loads.begin(), requests.loads.end(), [&](const LoadRequest& load) { add_load(load); });
    }
    add_foreign_containers();
    for (const std::string& topic : topics_) {
      graph_.topics.push_back({"topic " + topic, {topic}});
    }
    return std::move(graph_);
  }

 private:
  // `starter` is the handler that visits the plan; empty for the launch itself.
  void add_plan(const LaunchPlan& plan, const std::string& starter) {
    const std::vector<std::string> ids = add_processes(plan.processes, plan.nodes, plan.delays);
    for (std::size_t i = 0; i < plan.processes.size(); ++i) {
      names_.emplace(plan.processes[i].name, ids[i]);
      for (const std::string& name : plan.processes[i].other_names) {
        names_.emplace(name, ids[i]);
      }
      if (!starter.empty()) {
        graph_.edges.push_back({starter, ids[i], Relation::kStarts, "starts"});
      }
    }
    for_each_request(plan,
                     Overloaded{
                         [&](const LoadRequest& load) { add_load(load); },
                         [&](const Dependency& dependency) { add_dependency(dependency, ids[dependency.process]); },
                         PassOver<ProcessSpec, NodeDescription, EventHandler>(),          // before and after the others
                         PassOver<ProcessCommand, TransitionRequest, ShutdownRequest>(),  // lines of a handler's box
                         PassOver<RunScopePtr, UnregisterRequest, TestRequest, TimerRequest, CoroutineRequest>(),
                     });
    for (std::size_t i = 0; i < plan.handlers.size(); ++i) {
      const std::string id = add_handler(plan.handlers[i], plan.reactions[i]);
      if (const auto process = names_.find(plan.handlers[i].process); process != names_.end()) {
        graph_.edges.push_back({process->second, id, Relation::kHandles, ""});
      }
      add_plan(plan.reactions[i], id);
    }
  }

  // An EventHandler of Python with a matcher of its own waits for every kind of event: it is one box.
  bool is_further_event(const EventHandler& handler) const {
    const SourceRange& where = handler.where;
    return last_handler_ != nullptr && handler.process.empty() && last_handler_->process.empty() && where &&
           where.file == last_handler_->where.file && where.begin == last_handler_->where.begin &&
           where.file->path().ends_with(".py");
  }

  std::string add_handler(const EventHandler& handler, const LaunchPlan& reaction) {
    if (is_further_event(handler)) {
      LaunchGraph::Box& box = graph_.handlers.back();
      box.lines.front() =
          fmt::format("event handler in line {}", handler.where.file->position(handler.where.begin).line);
      return box.id;
    }
    last_handler_ = &handler;
    const std::string id = fmt::format("handler {}", graph_.handlers.size());
    std::vector<std::string> lines = {describe(handler)};
    for (const LeftToRun& left : reaction.left_to_run) {
      lines.push_back(left.function.empty() ? "does what only a run tells" : "calls " + left.function);
    }
    for (const TransitionRequest& request : reaction.transitions) {
      lines.push_back(fmt::format("changes the state of {}: {}", request.node, fmt::join(request.transitions, ", ")));
    }
    for (const ProcessCommand& command : reaction.commands) {
      const std::string label = verb_of(command.kind);
      if (const auto process = names_.find(command.process); process != names_.end()) {
        graph_.edges.push_back({id, process->second, Relation::kStarts, label});
      } else {
        lines.push_back(fmt::format("{} '{}'", label, command.process));
      }
    }
    if (!reaction.shutdowns.empty()) {
      lines.emplace_back("ends the launch");
    }
    graph_.handlers.push_back({id, std::move(lines)});
    asked_by(handler.where, id);
    return id;
  }

  // Components may be loaded into a container that another launch has started.
  void add_foreign_containers() {
    std::set<std::string> containers;
    for (const LaunchGraph::Edge& edge : graph_.edges) {
      if (edge.relation == Relation::kLoads && !ids_.contains(edge.from)) {
        containers.insert(edge.from);
      }
    }
    for (const std::string& container : containers) {
      const std::string name_space = container.substr(0, std::max<std::size_t>(container.rfind('/'), 1));
      graph_.nodes[name_space].push_back({container, {container, "not started here"}});
    }
  }

  // Returns the ids of the processes, whether they are nodes or not.
  std::vector<std::string> add_processes(const std::vector<ProcessSpec>& processes,
                                         const std::vector<NodeDescription>& nodes,
                                         const std::vector<Duration>& delays) {
    const auto remark_delay = [&](std::size_t process, std::vector<std::string>& lines) {
      if (process < delays.size() && delays[process] > Duration(0)) {
        lines.push_back(fmt::format("after {} s", std::chrono::duration<double>(delays[process]).count()));
      }
    };
    std::vector<std::string> ids(processes.size());
    for (const NodeDescription& node : nodes) {
      const ProcessSpec& spec = processes[node.process];
      std::vector<std::string> lines = {node.package ? fmt::format("{} {}", *node.package, node.executable)
                                                     : node.executable};
      if (!node.name) {
        lines.emplace_back("named by the program");
      }
      remark_delay(node.process, lines);
      ids[node.process] = add_node(node.name.value_or(spec.name), node.name_space.value_or("/"), lines, spec.origin,
                                   remaps_of(spec.argv), spec.machine);
    }
    for (std::size_t i = 0; i < processes.size(); ++i) {
      if (ids[i].empty()) {
        ids[i] = fmt::format("process {}", graph_.processes.size());
        std::vector<std::string> lines = {processes[i].name};
        remark_delay(i, lines);
        remark_left_out(lines);
        graph_.processes.push_back({ids[i], std::move(lines), left_out_, processes[i].machine});
        asked_by(processes[i].origin, ids[i]);
      }
    }
    return ids;
  }

  void remark_left_out(std::vector<std::string>& lines) const {
    if (left_out_) {
      lines.emplace_back("left out by a condition");
    }
  }

  void add_load(const LoadRequest& request) {
    const std::string target = joined_name("/", request.target.substr(request.target.starts_with('/') ? 1 : 0));
    for (const ComposableNode& component : request.nodes) {
      std::vector<std::string> lines = {fmt::format("{} in {}", component.plugin, target)};
      if (component.name.empty()) {
        lines.emplace_back("named by the program");
      }
      const std::string id = add_node(component.name.empty() ? component.plugin : component.name,
                                      component.name_space.empty() ? "/" : component.name_space, lines,
                                      component.origin, component.remaps, machine_of(target));
      graph_.edges.push_back({target, id, Relation::kLoads, "loads"});
    }
  }

  // Of a container; a component runs there.
  std::string machine_of(const std::string& container) const {
    for (const auto& [name_space, nodes] : graph_.nodes) {
      const auto found =
          std::find_if(nodes.begin(), nodes.end(), [&](const LaunchGraph::Box& node) { return node.id == container; });
      if (found != nodes.end()) {
        return found->machine;
      }
    }
    return {};
  }

  // A process is drawn with an arrow; anything else that is waited for is a line of the box.
  void add_dependency(const Dependency& dependency, const std::string& id) {
    const auto* const condition = std::get_if<ProcessCondition>(&dependency.condition);
    if (const auto target = condition != nullptr ? names_.find(condition->process) : names_.end();
        target != names_.end()) {
      graph_.edges.push_back({id, target->second, Relation::kWaitsFor, "waits until " + describe(dependency)});
      return;
    }
    const auto add_line = [&](LaunchGraph::Box& box) {
      if (box.id == id) {
        box.lines.push_back("waits until " + describe(dependency));
      }
    };
    for (auto& [name_space, nodes] : graph_.nodes) {
      std::for_each(nodes.begin(), nodes.end(), add_line);
    }
    std::for_each(graph_.processes.begin(), graph_.processes.end(), add_line);
  }

  std::string add_node(const std::string& name, std::string name_space, std::vector<std::string> lines,
                       const SourceRange& origin, const std::vector<std::pair<std::string, std::string>>& remaps,
                       const std::string& machine) {
    if (name_space.empty() || name_space.front() != '/') {
      name_space = "/" + name_space;
    }
    // Several nodes of one name are drawn as several nodes, because a user wants to see that.
    const std::string full_name = joined_name(name_space, name);
    std::string id = full_name;
    for (int again = 2; !ids_.insert(id).second; ++again) {
      id = fmt::format("{} ({})", full_name, again);
    }
    lines.insert(lines.begin(), full_name);
    remark_left_out(lines);
    graph_.nodes[name_space].push_back({id, std::move(lines), left_out_, machine});
    asked_by(origin, id);
    for (const auto& [from, to] : remaps) {
      const std::string topic = resolved_name(to, name_space, full_name);
      topics_.insert(topic);
      graph_.edges.push_back({id, "topic " + topic, Relation::kRemaps, from});
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

  const EventHandler* last_handler_ = nullptr;  // the last one that got a box
  bool left_out_ = false;                       // what is added now is left out by a condition
  LaunchGraph graph_;
  std::map<std::string, std::string> names_;  // of processes, with their ids
  std::set<std::string> topics_;
  std::set<std::string> ids_;
  std::set<std::pair<std::string, std::string>> includes_;
};

}  // namespace

std::vector<std::string> LaunchGraph::machines() const {
  std::set<std::string> found;
  for (const auto& [name_space, boxes] : nodes) {
    for (const Box& node : boxes) {
      found.insert(node.machine);
    }
  }
  for (const Box& process : processes) {
    found.insert(process.machine);
  }
  return {found.begin(), found.end()};
}

std::string title_of_machine(const std::string& machine) {
  return machine.empty() ? "this machine" : "machine " + machine;
}

LaunchGraph graph_of(const LaunchPlan& plan, const std::vector<Requests>& left_out) {
  return GraphBuilder().build(plan, left_out);
}

}  // namespace launch
