// SPDX-License-Identifier: Apache-2.0
// launch component standalone, and the loading of components
#include "programs/ros/component_loading.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <fstream>
#include <map>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/message_types/yaml_text.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/parameter_verb.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

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

namespace {

std::string parameter_list(const std::vector<std::string>& words) {
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

}  // namespace

void ComponentOptions::declare(CLI::App& app) {
  app.add_option("package", package_, "package of the component")->required();
  app.add_option("plugin", plugin_, "class of the component, such as demo_nodes_cpp::Talker")->required();
  app.add_option("-n,--node-name", name_, "name of the node");
  app.add_option("--node-namespace", namespace_, "namespace of the node");
  app.add_option("--log-level", level_, "DEBUG, INFO, WARN, ERROR or FATAL")
      ->check(CLI::IsMember({"DEBUG", "INFO", "WARN", "ERROR", "FATAL"}, CLI::ignore_case));
  const auto repeated = [&app](const char* names, std::vector<std::string>& words, const char* help) {
    app.add_option(names, words, help)->take_all()->expected(1)->allow_extra_args(false);
  };
  repeated("-r,--remap-rule", remaps_, "from:=to; may be repeated");
  repeated("-p,--parameter", parameters_, "name:=value; may be repeated");
  repeated("-e,--extra-argument", extra_, "name:=value; may be repeated");
}

ComponentOptions::Loaded ComponentOptions::load_into(GraphSession& session, const std::string& container) const {
  static const std::map<std::string, int> levels = {{"", 0},      {"debug", 10}, {"info", 20},
                                                    {"warn", 30}, {"error", 40}, {"fatal", 50}};
  const std::string request = fmt::format(
      "{{package_name: {}, plugin_name: {}, node_name: {}, node_namespace: {}, log_level: {}, remap_rules: {}, "
      "parameters: {}, extra_arguments: {}}}",
      yaml_text(package_, true), yaml_text(plugin_, true), yaml_text(name_, true), yaml_text(namespace_, true),
      levels.at(CLI::detail::to_lower(level_)), yaml_list(remaps_), parameter_list(parameters_),
      parameter_list(extra_));
  const Reply reply = ask(session, container + "/_container/load_node", "composition_interfaces/srv/LoadNode", request);
  if (!std::get<bool>(reply.at("success").data)) {
    throw CommandError("the component was not loaded: " + text_of(reply.at("error_message")));
  }
  return {number_of(reply.at("unique_id")), text_of(reply.at("full_node_name"))};
}

namespace {

// A container that ends with this command, whatever ends it.
class Container {
 public:
  // Before threads begin. Throws CommandError.
  explicit Container(const std::string& name) {
    const std::string program =
        PackageIndex(own_prefix()).executable("component_container", "rclcpp_components", own_environment());
    const std::string node = "__node:=" + name;
    const char* const words[] = {program.c_str(), "--ros-args", "-r", node.c_str(), nullptr};
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::setpgid(0, 0);  // this command passes Ctrl-C on
      if (::prctl(PR_SET_PDEATHSIG, SIGTERM) == 0 && ::getppid() == parent) {
        ::execv(program.c_str(), const_cast<char* const*>(words));  // exec does not write, C has no way to say so
      }
      ::_exit(127);
    }
    if (pid_ < 0) {
      throw CommandError("cannot start a process");
    }
  }
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;
  ~Container() { end(); }

  bool has_ended() {
    if (!status_) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        status_ = status;
      }
    }
    return status_.has_value();
  }

  // Asks it to end, and waits for that. Returns the exit code, or 128+N after signal N.
  int end() {
    if (!has_ended()) {
      ::kill(pid_, SIGINT);
      int status = 0;
      while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
      }
      status_ = status;
    }
    return WIFSIGNALED(*status_) ? 128 + WTERMSIG(*status_) : WEXITSTATUS(*status_);
  }

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

class ComponentStandalone final : public Verb {
 public:
  void declare(CLI::App& app) override {
    component_.declare(app);
    app.add_option("-c,--container-node-name", container_name_, "name of the container; default: one of its own");
    look_.declare(app);
  }

  int run() override {
    if (container_name_.empty()) {
      container_name_ = fmt::format("standalone_container_{}", ::getpid());
    }
    Container container(container_name_);
    GraphSession session;
    const std::string name = full_name(container_name_);
    const auto is_there = [&] { return container.has_ended() || has_node(session, name); };
    while (!session.wait_until(is_there, kLook) && !GraphSession::is_stopped()) {
    }
    if (!GraphSession::is_stopped() && !container.has_ended()) {
      const auto [id, node] = component_.load_into(session, name);
      put(fmt::format("Loaded component {} into '{}' container node as '{}'\n", id, name, node));
    }
    while (!GraphSession::is_stopped() && !container.has_ended()) {
      session.sleep_until(SessionClock::now() + std::chrono::duration_cast<SessionClock::duration>(kLook));
    }
    return container.end();
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty()       ? packages_with_components()
           : words.size() == 1 ? component_types(words.front())
                               : std::vector<std::string>();
  }

 private:
  static constexpr Seconds kLook{0.2};  // between looks whether the container still runs

  static bool has_node(GraphSession& session, const std::string& name) {
    const std::vector<std::string> names = node_names(session, true);
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  ComponentOptions component_;
  std::string container_name_;
  LookOptions look_;
};

}  // namespace

std::vector<VerbInfo> component_standalone_verbs() {
  return {{"component", "standalone", "runs a component in a container of its own", make_verb<ComponentStandalone>}};
}

}  // namespace launch
