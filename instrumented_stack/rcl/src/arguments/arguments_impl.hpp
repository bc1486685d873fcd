// SPDX-License-Identifier: Apache-2.0
// The parsed command line, and the remap rules in it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rcl/arguments.h"
#include "rcl/parameter_overrides.hpp"

namespace rcl {

// How the readers of arguments and of parameter files report errors in their input.
[[noreturn]] inline void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

// One remap rule of a command line: `[node:]FROM:=TO`.
struct RemapRule {
  enum class Kind {
    kName,       // FROM:=TO, topics and services
    kTopic,      // rostopic://FROM:=TO
    kService,    // rosservice://FROM:=TO
    kNodeName,   // __node:=TO or __name:=TO
    kNamespace,  // __ns:=TO
  };

  Kind kind;
  std::string node;  // the rule applies only to nodes of this name; empty: to all
  std::string from;  // unused for node names and namespaces; may be relative or begin with `~/`
  std::string to;
};

// Throws std::invalid_argument with the problem, in words that follow `'TEXT' is no remap rule: `.
RemapRule parse_remap_rule(std::string_view text);

// The new name of a topic or service (Kind kTopic, kService); `name` is its full name.
std::optional<std::string> remapped_name(const std::vector<RemapRule>& rules, RemapRule::Kind kind,
                                         std::string_view name, std::string_view node_name,
                                         std::string_view node_namespace);

// The new name or namespace (Kind kNodeName, kNamespace) of the node.
std::optional<std::string> remapped_node(const std::vector<RemapRule>& rules, RemapRule::Kind kind,
                                         std::string_view node_name);

}  // namespace rcl

struct rcl_arguments_impl_s {
  std::vector<int> unparsed;      // indices into argv
  std::vector<int> unparsed_ros;  // indices into argv, inside ROS sections
  std::vector<rcl::RemapRule> remap_rules;
  rcl::ParameterOverrides parameters;
  std::vector<std::string> parameter_files;
  std::optional<std::string> enclave;
  std::optional<int> default_log_level;
  std::vector<std::pair<std::string, int>> logger_levels;
  std::string log_config_file;
  std::string log_file_name;
  bool stdout_logs = true;
  bool rosout_logs = true;
  bool external_logs = true;
};
