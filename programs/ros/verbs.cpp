// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <rmw/validate_full_topic_name.h>

#include <algorithm>
#include <cstdio>
#include <tuple>

#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

const std::vector<VerbInfo>& all_verbs() {
  static const std::vector<VerbInfo> verbs = [] {
    std::vector<VerbInfo> all;
    for (const auto& verbs_of_file :
         {action_verbs, clock_verbs, component_verbs, component_standalone_verbs, event_echo_verbs, graph_name_verbs,
          interface_verbs, lifecycle_verbs, loglevel_verbs, node_verbs, param_file_verbs, param_verbs, service_verbs,
          topic_echo_verbs, topic_info_verbs, topic_pub_verbs, topic_rate_verbs}) {
      for (VerbInfo& verb : verbs_of_file()) {
        all.push_back(std::move(verb));
      }
    }
    std::sort(all.begin(), all.end(), [](const VerbInfo& a, const VerbInfo& b) {
      return std::tie(a.command, a.name) < std::tie(b.command, b.name);
    });
    return all;
  }();
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
