// SPDX-License-Identifier: Apache-2.0
// launch loglevel
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/yaml_text.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/parameter_verb.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

// rcl_interfaces/msg/LoggerLevel
constexpr std::array<std::pair<std::int64_t, const char*>, 6> kLevels{
    {{10, "debug"}, {20, "info"}, {30, "warn"}, {40, "error"}, {50, "fatal"}, {0, "unset"}}};

std::vector<std::string> level_names() {
  std::vector<std::string> names;
  for (const auto& [number, name] : kLevels) {
    names.emplace_back(name);
  }
  return names;
}

std::string name_of_level(std::int64_t level) {
  for (const auto& [number, name] : kLevels) {
    if (number == level) {
      return name;
    }
  }
  return fmt::to_string(level);
}

std::int64_t number_of_level(const std::string& wanted) {
  for (const auto& [number, name] : kLevels) {
    if (wanted == name) {
      return number;
    }
  }
  const std::string nearest = did_you_mean(wanted, level_names());
  throw CommandError(fmt::format("there is no level '{}'", wanted),
                     nearest.empty() ? fmt::format("the levels are {}", fmt::join(level_names(), ", ")) : nearest);
}

// "/left/talker" -> "left.talker", the name that rclcpp gives to the logger of a node.
std::string logger_of(const std::string& node) {
  std::string name = node.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

bool is_pattern(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

// A pattern with a slash is for full names, another one for names without their namespace.
bool matches(const std::string& pattern, const std::string& node) {
  const std::string name = pattern.find('/') == std::string::npos ? node.substr(node.rfind('/') + 1) : node;
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

class Loglevel final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("node", node_, "name of the node, or a pattern such as '/left/*'")->required();
    app.add_option("level", level_, "debug, info, warn, error, fatal, or unset; without it the level is printed");
    app.add_option("--logger", logger_, "another logger of the node's process");
    // `launch` itself takes this option; it is here for the help.
    app.add_option("--on", on_, "ask on another machine, through a command such as 'ssh robot'; default: LAUNCH_ON");
    look_.declare(app);
  }

  int run() override {
    const bool sets = !level_.empty();
    const std::int64_t level = sets ? number_of_level(level_) : 0;
    GraphSession session;
    int exit_code = 0;
    for (const std::string& node : find_nodes(session)) {
      const std::string logger = logger_.empty() ? logger_of(node) : logger_;
      if (sets && !set(session, node, logger, level)) {
        exit_code = 1;
      } else {
        put(fmt::format("{}: {}\n", node, name_of_level(level_of(session, node, logger))));
      }
    }
    return exit_code;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_node_names() : words.size() == 1 ? level_names() : std::vector<std::string>();
  }

 private:
  // Full names. Throws CommandError if there is none, or none that has the services.
  std::vector<std::string> find_nodes(GraphSession& session) const {
    constexpr Seconds kPatienceForServices{3.0};  // the services of a node are found after its name
    if (!is_pattern(node_)) {
      const std::string node = require_node(session, node_, look_.time());
      session.wait_until([&] { return has_service(session, node); }, look_.time().value_or(kPatienceForServices));
      if (!has_service(session, node)) {
        throw no_service(fmt::format("the node '{}' has no services for the levels of its loggers", node));
      }
      return {node};
    }
    session.discover(look_.time());
    std::vector<std::string> nodes = node_names(session, false);
    std::erase_if(nodes, [this](const std::string& node) { return !matches(node_, node); });
    if (nodes.empty()) {
      throw CommandError(fmt::format("no node matches '{}'", node_));
    }
    std::erase_if(nodes, [&](const std::string& node) { return !has_service(session, node); });
    if (nodes.empty()) {
      throw no_service(fmt::format("no node that matches '{}' has services for the levels of its loggers", node_));
    }
    return nodes;
  }

  static bool has_service(GraphSession& session, const std::string& node) {
    const NamesAndTypes services = names_of_node(session, node, OfNode::kServices);
    return services.count(node + "/set_logger_levels") != 0 && services.count(node + "/get_logger_levels") != 0;
  }

  static CommandError no_service(const std::string& what) {
    return CommandError(what,
                        "a program has them with rclcpp::NodeOptions().enable_logger_service(true); 'launch "
                        "--log-level NODE:=LEVEL' sets a level at the start of any node");
  }

  static std::int64_t level_of(GraphSession& session, const std::string& node, const std::string& logger) {
    const Reply reply = ask(session, node + "/get_logger_levels", "rcl_interfaces/srv/GetLoggerLevels",
                            fmt::format("{{names: {}}}", yaml_list({logger})));
    const MessageType& type = *reply.type->find("levels")->type.message;
    const MessageValue::List& levels = reply.at("levels").list();
    if (levels.empty()) {
      throw CommandError(fmt::format("'{}' has not told the level of '{}'", node, logger));
    }
    return number_of(member(type, levels.front(), "level"));
  }

  static bool set(GraphSession& session, const std::string& node, const std::string& logger, std::int64_t level) {
    const Reply reply = ask(session, node + "/set_logger_levels", "rcl_interfaces/srv/SetLoggerLevels",
                            fmt::format("{{levels: [{{name: {}, level: {}}}]}}", yaml_text(logger, true), level));
    const MessageType& type = *reply.type->find("results")->type.message;
    const MessageValue::List& results = reply.at("results").list();
    if (!results.empty() && std::get<bool>(member(type, results.front(), "successful").data)) {
      return true;
    }
    fmt::print(stderr, "{}: the level was not set{}\n", node,
               results.empty() ? "" : ": " + text_of(member(type, results.front(), "reason")));
    return false;
  }

  std::string node_;
  std::string level_;
  std::string logger_;
  std::string on_;
  LookOptions look_;
};

}  // namespace

std::vector<VerbInfo> loglevel_verbs() {
  return {{"loglevel", "", "prints or sets the level of the loggers of nodes", make_verb<Loglevel>}};
}

}  // namespace launch
