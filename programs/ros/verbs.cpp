// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <rmw/validate_full_topic_name.h>

#include <algorithm>
#include <cstdio>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

const std::vector<VerbInfo>& all_verbs() {
  static const std::vector<VerbInfo> verbs = {
      {"topic", "bw", "measures the bytes that come on a topic", make_topic_bw},
      {"topic", "delay", "measures how old the messages of a topic are when they come", make_topic_delay},
      {"topic", "echo", "prints the messages of a topic", make_topic_echo},
      {"topic", "find", "lists the topics of a type", make_topic_find},
      {"topic", "hz", "measures how often messages come", make_topic_hz},
      {"topic", "info", "describes a topic", make_topic_info},
      {"topic", "list", "lists the topics", make_topic_list},
      {"topic", "pub", "publishes messages", make_topic_pub},
      {"topic", "type", "prints the type of a topic", make_topic_type},
      {"node", "info", "describes a node", make_node_info},
      {"node", "list", "lists the nodes", make_node_list},
      {"service", "call", "calls a service", make_service_call},
      {"service", "find", "lists the services of a type", make_service_find},
      {"service", "info", "describes a service", make_service_info},
      {"service", "list", "lists the services", make_service_list},
      {"service", "type", "prints the type of a service", make_service_type},
      {"param", "delete", "deletes a parameter", make_param_delete},
      {"param", "describe", "describes parameters", make_param_describe},
      {"param", "dump", "prints all parameters of a node as a parameter file", make_param_dump},
      {"param", "get", "prints the value of a parameter", make_param_get},
      {"param", "list", "lists the parameters", make_param_list},
      {"param", "load", "sets the parameters of a parameter file", make_param_load},
      {"param", "set", "sets a parameter", make_param_set},
      {"action", "info", "describes an action", make_action_info},
      {"action", "list", "lists the actions", make_action_list},
      {"action", "send_goal", "sends a goal and waits for its result", make_action_send_goal},
      {"action", "type", "prints the type of an action", make_action_type},
      {"lifecycle", "get", "prints the state of nodes with a life cycle", make_lifecycle_get},
      {"lifecycle", "list", "lists the transitions of a node", make_lifecycle_list},
      {"lifecycle", "nodes", "lists the nodes with a life cycle", make_lifecycle_nodes},
      {"lifecycle", "set", "makes a transition", make_lifecycle_set},
      {"clock", "", "publishes simulated time on /clock", make_clock},
      {"loglevel", "", "prints or sets the level of the loggers of nodes", make_loglevel},
      {"component", "list", "lists containers and their components", make_component_list},
      {"component", "load", "loads a component into a container", make_component_load},
      {"component", "types", "lists the components that are installed", make_component_types},
      {"component", "unload", "unloads components from a container", make_component_unload},
      {"interface", "list", "lists the installed interfaces", make_interface_list},
      {"interface", "package", "lists the interfaces of a package", make_interface_package},
      {"interface", "packages", "lists the packages that have interfaces", make_interface_packages},
      {"interface", "proto", "prints a message with its defaults, to be edited", make_interface_proto},
      {"interface", "show", "prints the definition of an interface", make_interface_show},
  };
  return verbs;
}

const std::vector<CommandOfVerbs>& all_commands() {
  static const std::vector<CommandOfVerbs> commands = {
      {"topic", "lists, prints, measures and publishes topics"},
      {"node", "lists and describes nodes"},
      {"service", "lists, describes and calls services"},
      {"param", "lists, prints and sets parameters of nodes"},
      {"action", "lists and describes actions, and sends goals"},
      {"lifecycle", "shows and changes the states of nodes with a life cycle"},
      {"component", "lists, loads and unloads components"},
      {"clock", "publishes simulated time on /clock"},
      {"loglevel", "prints or sets the level of the loggers of nodes"},
      {"interface", "shows the messages, services and actions that are installed"},
  };
  return commands;
}

InterfaceLibrary& installed_interfaces() {
  static InterfaceLibrary library(PackageIndex(own_prefix()), own_environment());
  return library;
}

LocatedText word_of_command_line(const std::string& what, const std::string& text) {
  const auto file = std::make_shared<const SourceFile>(what, text);
  return LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())});
}

std::string full_name(const std::string& name) {
  const std::string full = name.starts_with('/') ? name : "/" + name;
  int result = RMW_TOPIC_VALID;
  std::size_t at = 0;
  if (rmw_validate_full_topic_name(full.c_str(), &result, &at) != RMW_RET_OK || result != RMW_TOPIC_VALID) {
    throw CommandError(fmt::format("'{}' is not a valid name", name),
                       rmw_full_topic_name_validation_result_string(result));
  }
  return full;
}

bool is_hidden(std::string_view name) {
  return name.starts_with('_') || name.find("/_") != std::string_view::npos;
}

void put(std::string_view text) {
  (void)std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0) {
    throw CommandError("can't write to standard output");
  }
}

}  // namespace launch
