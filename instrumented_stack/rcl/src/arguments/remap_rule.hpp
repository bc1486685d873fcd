// SPDX-License-Identifier: Apache-2.0
// One remap rule of a command line: `[node:]FROM:=TO`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rcl {

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
