// SPDX-License-Identifier: Apache-2.0
// launch component list, load, unload, types
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "programs/ros/component_loading.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr const char* kListNodes = "/_container/list_nodes";
constexpr const char* kListNodesType = "composition_interfaces/srv/ListNodes";

std::vector<std::string> containers(GraphSession& session) {
  return nodes_with_service(session, kListNodes, kListNodesType);
}

// Commands on one container.
class ContainerVerb : public Verb {
 public:
  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    if (!words.empty()) {
      return {};
    }
    GraphSession session;
    session.discover(std::nullopt);
    return containers(session);
  }

 protected:
  void declare_container(CLI::App& app, bool required) {
    app.add_option("container", container_, required ? "name of the container" : "name of the container; default: all")
        ->required(required);
    look_.declare(app);
  }

  std::string container_;
  LookOptions look_;
};

class ComponentList final : public ContainerVerb {
 public:
  void declare(CLI::App& app) override {
    declare_container(app, false);
    app.add_flag("--containers-only", only_containers_, "print no components");
  }

  int run() override {
    GraphSession session;
    if (!container_.empty()) {
      const std::string container = require_node(session, container_, look_.time());
      put(only_containers_ ? "" : components(session, container, ""));
      return 0;
    }
    session.discover(look_.time());
    for (const std::string& container : containers(session)) {
      put(container + "\n" + (only_containers_ ? "" : components(session, container, "  ")));
    }
    return 0;
  }

 private:
  static std::string components(GraphSession& session, const std::string& container, const char* indent) {
    const Reply reply = ask(session, container + kListNodes, kListNodesType, "{}");
    const MessageValue::List& names = reply.at("full_node_names").list();
    const MessageValue::List& ids = reply.at("unique_ids").list();
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < ids.size(); ++i) {
      text += fmt::format("{}{}  {}\n", indent, number_of(ids[i]), text_of(names[i]));
    }
    return text;
  }

  bool only_containers_ = false;
};

class ComponentLoad final : public ContainerVerb {
 public:
  void declare(CLI::App& app) override {
    declare_container(app, true);
    component_.declare(app);
    app.add_flag("-q,--quiet", quiet_, "print only number and name");
  }

  int run() override {
    GraphSession session;
    const std::string container = require_node(session, container_, look_.time());
    const auto [id, node] = component_.load_into(session, container);
    put(quiet_ ? fmt::format("{}  {}\n", id, node)
               : fmt::format("Loaded component {} into '{}' container node as '{}'\n", id, container, node));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty()       ? ContainerVerb::complete(words)
           : words.size() == 1 ? packages_with_components()
                               : component_types(words[1]);
  }

 private:
  ComponentOptions component_;
  bool quiet_ = false;
};

class ComponentUnload final : public ContainerVerb {
 public:
  void declare(CLI::App& app) override {
    declare_container(app, true);
    app.add_option("id", ids_, "numbers of the components, as 'launch component list' prints them")->required();
    app.add_flag("-q,--quiet", quiet_, "print only the number");
  }

  int run() override {
    GraphSession session;
    const std::string container = require_node(session, container_, look_.time());
    for (const std::uint64_t id : ids_) {
      const Reply reply = ask(session, container + "/_container/unload_node", "composition_interfaces/srv/UnloadNode",
                              fmt::format("{{unique_id: {}}}", id));
      if (!std::get<bool>(reply.at("success").data)) {
        throw CommandError(fmt::format("component {} was not unloaded from '{}': {}", id, container,
                                       text_of(reply.at("error_message"))));
      }
      put(quiet_ ? fmt::format("{}\n", id)
                 : fmt::format("Unloaded component {} from '{}' container node\n", id, container));
    }
    return 0;
  }

 private:
  std::vector<std::uint64_t> ids_;
  bool quiet_ = false;
};

class ComponentTypes final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("package", package_, "name of the package; default: all packages");
  }

  int run() override {
    if (!package_.empty()) {
      const std::vector<std::string> types = types_of_package();
      put(types.empty() ? "" : fmt::format("{}\n", fmt::join(types, "\n")));
      return 0;
    }
    for (const std::string& package : packages_with_components()) {
      put(fmt::format("{}\n  {}\n", package, fmt::join(component_types(package), "\n  ")));
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? packages_with_components() : std::vector<std::string>();
  }

 private:
  std::vector<std::string> types_of_package() const {
    try {
      return component_types(package_);
    } catch (const std::runtime_error&) {
      throw CommandError(fmt::format("package '{}' is not found", package_),
                         PackageIndex(own_prefix()).help_for_missing(package_, own_environment()));
    }
  }

  std::string package_;
};

}  // namespace

std::vector<VerbInfo> component_verbs() {
  return {{"component", "list", "lists containers and their components", make_verb<ComponentList>},
          {"component", "load", "loads a component into a container", make_verb<ComponentLoad>},
          {"component", "types", "lists the components that are installed", make_verb<ComponentTypes>},
          {"component", "unload", "unloads components from a container", make_verb<ComponentUnload>}};
}

}  // namespace launch
