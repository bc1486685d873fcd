// SPDX-License-Identifier: Apache-2.0
// launch lifecycle nodes, list, get, set
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "base/diagnostics/diagnostic.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr const char* kGetState = "lifecycle_msgs/srv/GetState";
constexpr const char* kTransitions = "lifecycle_msgs/srv/GetAvailableTransitions";

std::vector<std::string> managed_nodes(GraphSession& session) {
  return nodes_with_service(session, "/get_state", kGetState);
}

struct TransitionInfo {
  std::string label, start, goal;
  std::int64_t id = 0;
};

std::vector<TransitionInfo> transitions_of(GraphSession& session, const std::string& node, bool all) {
  const Reply reply =
      ask(session, node + (all ? "/get_transition_graph" : "/get_available_transitions"), kTransitions, "{}");
  const MessageType& type = *reply.type->find("available_transitions")->type.message;
  std::vector<TransitionInfo> transitions;
  for (const MessageValue& each : reply.at("available_transitions").list()) {
    const auto part = [&](const char* of, const char* name) -> const MessageValue& {
      return member(*type.find(of)->type.message, member(type, each, of), name);
    };
    transitions.push_back({text_of(part("transition", "label")), text_of(part("start_state", "label")),
                           text_of(part("goal_state", "label")), number_of(part("transition", "id"))});
  }
  return transitions;
}

// Commands on one node with a life cycle.
class LifecycleVerb : public Verb {
 public:
  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    GraphSession session;
    session.discover(std::nullopt);
    return words.empty() ? managed_nodes(session) : std::vector<std::string>();
  }

 protected:
  void declare_node(CLI::App& app, bool required) {
    app.add_option("node", node_, required ? "name of the node" : "name of the node; default: all")->required(required);
    look_.declare(app);
    app.add_flag("--include-hidden-nodes", hidden_, "also nodes whose name begins with '_'");
  }

  std::string node_;
  LookOptions look_;
  bool hidden_ = false;
};

class LifecycleNodes final : public Verb {
 public:
  void declare(CLI::App& app) override { options_.declare(app); }

  int run() override {
    GraphSession session;
    session.discover(options_.time());
    std::vector<std::string> nodes = managed_nodes(session);
    std::erase_if(nodes, [this](const std::string& node) { return !options_.all && is_hidden(node); });
    put(options_.count  ? fmt::format("{}\n", nodes.size())
        : nodes.empty() ? ""
                        : fmt::format("{}\n", fmt::join(nodes, "\n")));
    return 0;
  }

 private:
  NodeListOptions options_;
};

class LifecycleList final : public LifecycleVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app, true);
    app.add_flag("-a,--all", all_, "also transitions that are not possible now");
  }

  int run() override {
    GraphSession session;
    for (const TransitionInfo& each : transitions_of(session, require_node(session, node_, look_.time()), all_)) {
      put(fmt::format("- {} [{}]\n\tStart: {}\n\tGoal: {}\n", each.label, each.id, each.start, each.goal));
    }
    return 0;
  }

 private:
  bool all_ = false;
};

class LifecycleGet final : public LifecycleVerb {
 public:
  void declare(CLI::App& app) override { declare_node(app, false); }

  int run() override {
    GraphSession session;
    if (!node_.empty()) {
      put(state_of(session, require_node(session, node_, look_.time())) + "\n");
      return 0;
    }
    session.discover(look_.time());
    for (const std::string& node : managed_nodes(session)) {
      if (hidden_ || !is_hidden(node)) {
        put(fmt::format("{}: {}\n", node, state_of(session, node)));
      }
    }
    return 0;
  }

 private:
  static std::string state_of(GraphSession& session, const std::string& node) {
    const Reply reply = ask(session, node + "/get_state", kGetState, "{}");
    return fmt::format("{} [{}]", text_of(reply.at("current_state.label")), number_of(reply.at("current_state.id")));
  }
};

class LifecycleSet final : public LifecycleVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app, true);
    app.add_option("transition", transition_, "label or number of the transition")->required();
  }

  int run() override {
    GraphSession session;
    const std::string node = require_node(session, node_, look_.time());
    const std::vector<TransitionInfo> transitions = transitions_of(session, node, false);
    std::optional<std::int64_t> id;
    std::string available;
    std::vector<std::string> labels;
    for (const TransitionInfo& each : transitions) {
      if (!id && (each.label == transition_ || fmt::to_string(each.id) == transition_)) {
        id = each.id;
      }
      available += fmt::format("{}{} [{}]", available.empty() ? "" : ", ", each.label, each.id);
      labels.push_back(each.label);
    }
    if (!id) {
      const std::string nearest = did_you_mean(transition_, labels);
      throw CommandError(fmt::format("'{}' has no transition '{}' now", node, transition_),
                         nearest.empty() ? "its transitions are " + available : nearest);
    }
    const Reply reply = ask(session, node + "/change_state", "lifecycle_msgs/srv/ChangeState",
                            fmt::format("{{transition: {{id: {}}}}}", *id));
    if (std::get<bool>(reply.at("success").data)) {
      put("Transitioning successful\n");
      return 0;
    }
    fmt::print(stderr, "Transitioning failed\n");
    return 1;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    if (words.size() != 1) {
      return LifecycleVerb::complete(words);
    }
    GraphSession session;
    std::vector<std::string> labels;
    for (const TransitionInfo& each :
         transitions_of(session, require_node(session, words.front(), std::nullopt), false)) {
      labels.push_back(each.label);
    }
    return labels;
  }

 private:
  std::string transition_;
};

}  // namespace

std::vector<VerbInfo> lifecycle_verbs() {
  return {{"lifecycle", "get", "prints the state of nodes with a life cycle", make_verb<LifecycleGet>},
          {"lifecycle", "list", "lists the transitions of a node", make_verb<LifecycleList>},
          {"lifecycle", "nodes", "lists the nodes with a life cycle", make_verb<LifecycleNodes>},
          {"lifecycle", "set", "makes a transition", make_verb<LifecycleSet>}};
}

}  // namespace launch
