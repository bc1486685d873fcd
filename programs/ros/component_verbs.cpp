// SPDX-License-Identifier: Apache-2.0
// launch component list, load, unload, types
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/message_types/yaml_text.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/parameter_verb.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr const char* kListNodes = "/_container/list_nodes";
constexpr const char* kListNodesType = "composition_interfaces/srv/ListNodes";

std::vector<std::string> containers(GraphSession& session) {
  return nodes_with_service(session, kListNodes, kListNodesType);
}

// The classes that a package has registered, in the order of the index.
std::vector<std::string> component_types(const std::string& package) {
  PackageIndex packages(own_prefix());
  const std::string prefix = packages.prefix(package, own_environment());
  std::ifstream file(fmt::format("{}/share/ament_index/resource_index/rclcpp_components/{}", prefix, package));
  std::vector<std::string> types;
  for (std::string line; std::getline(file, line);) {
    if (const std::size_t end = line.find(';'); end != std::string::npos) {
      types.push_back(line.substr(0, end));
    }
  }
  return types;
}

std::vector<std::string> packages_with_components() {
  std::vector<std::string> names = PackageIndex(own_prefix()).packages(own_environment());
  std::erase_if(names, [](const std::string& name) { return component_types(name).empty(); });
  return names;
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
    app.add_option("package", package_, "package of the component")->required();
    app.add_option("plugin", plugin_, "class of the component, such as demo_nodes_cpp::Talker")->required();
    app.add_option("-n,--node-name", name_, "name of the node");
    app.add_option("--node-namespace", namespace_, "namespace of the node");
    app.add_option("--log-level", level_, "DEBUG, INFO, WARN, ERROR or FATAL")
        ->check(CLI::IsMember({"DEBUG", "INFO", "WARN", "ERROR", "FATAL"}, CLI::ignore_case));
    app.add_option("-r,--remap-rule", remaps_, "from:=to; may be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    app.add_option("-p,--parameter", parameters_, "name:=value; may be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    app.add_option("-e,--extra-argument", extra_, "name:=value; may be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    app.add_flag("-q,--quiet", quiet_, "print only number and name");
  }

  int run() override {
    static const std::map<std::string, int> levels = {{"", 0},      {"debug", 10}, {"info", 20},
                                                      {"warn", 30}, {"error", 40}, {"fatal", 50}};
    const std::string request = fmt::format(
        "{{package_name: {}, plugin_name: {}, node_name: {}, node_namespace: {}, log_level: {}, remap_rules: {}, "
        "parameters: {}, extra_arguments: {}}}",
        yaml_text(package_, true), yaml_text(plugin_, true), yaml_text(name_, true), yaml_text(namespace_, true),
        levels.at(CLI::detail::to_lower(level_)), yaml_list(remaps_), parameter_list(parameters_),
        parameter_list(extra_));
    GraphSession session;
    const std::string container = require_node(session, container_, look_.time());
    const Reply reply =
        ask(session, container + "/_container/load_node", "composition_interfaces/srv/LoadNode", request);
    if (!std::get<bool>(reply.at("success").data)) {
      throw CommandError("the component was not loaded: " + text_of(reply.at("error_message")));
    }
    const std::int64_t id = number_of(reply.at("unique_id"));
    const std::string& node = text_of(reply.at("full_node_name"));
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
  static std::string parameter_list(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) {
      const std::size_t separator = word.find(":=");
      if (separator == std::string::npos) {
        throw CommandError(fmt::format("'{}' is not name:=value", word));
      }
      list += fmt::format("{}{{name: {}, value: {}}}", list.empty() ? "" : ", ",
                          yaml_text(word.substr(0, separator), true), parameter_value_yaml(word.substr(separator + 2)));
    }
    return "[" + list + "]";
  }

  std::string package_, plugin_, name_, namespace_, level_;
  std::vector<std::string> remaps_, parameters_, extra_;
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
