// SPDX-License-Identifier: Apache-2.0
// launch node list, info
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

class NodeList final : public Verb {
 public:
  void declare(CLI::App& app) override { options_.declare(app); }

  int run() override {
    GraphSession session;
    session.discover(options_.time());
    const std::vector<std::string> names = node_names(session, options_.all);
    if (options_.count) {
      put(fmt::format("{}\n", names.size()));
      return 0;
    }
    if (std::adjacent_find(names.begin(), names.end()) != names.end()) {
      fmt::print(stderr, "WARNING: some nodes of the graph have the same name, which can have unwanted effects.\n");
    }
    for (const std::string& name : names) {
      put(name + "\n");
    }
    return 0;
  }

 private:
  NodeListOptions options_;
};

class NodeInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("node", node_, "full name of the node")->required();
    look_.declare(app);
    app.add_flag("--include-hidden", hidden_, "also topics, services and actions whose name begins with '_'");
  }

  int run() override {
    GraphSession session;
    session.discover(look_.time());
    const std::string node = require_node(session, node_, look_.time());
    if (!look_.time()) {
      session.hear_endpoints(node);
    }
    const NamesAndTypes services = names_of_node(session, node, OfNode::kServices);
    const NamesAndTypes clients = names_of_node(session, node, OfNode::kClients);
    put(node + "\n" + section("Subscribers", names_of_node(session, node, OfNode::kSubscriptions)) +
        section("Publishers", names_of_node(session, node, OfNode::kPublishers)) +
        section("Service Servers", services) + section("Service Clients", clients) +
        section("Action Servers", actions_among(services)) + section("Action Clients", actions_among(clients)));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_node_names() : std::vector<std::string>();
  }

 private:
  std::string section(const std::string& title, const NamesAndTypes& names) const {
    std::string lines;
    for (const auto& [name, types] : names) {
      if (hidden_ || !is_hidden(name)) {
        lines += fmt::format("    {}: {}\n", name, fmt::join(types, ", "));
      }
    }
    return fmt::format("  {}:\n{}", title, lines.empty() ? "\n" : lines);
  }

  std::string node_;
  LookOptions look_;
  bool hidden_ = false;
};

}  // namespace

std::vector<VerbInfo> node_verbs() {
  return {{"node", "info", "describes a node", make_verb<NodeInfo>},
          {"node", "list", "lists the nodes", make_verb<NodeList>}};
}

}  // namespace launch
