// SPDX-License-Identifier: Apache-2.0
// Names of the ROS graph: which of them are valid, and how namespaces combine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "launcher/substitution/substitution.hpp"

namespace launch {

// Letters, digits and underscores, not starting with a digit.
bool is_valid_node_name(std::string_view name);

// The namespace that `given` means in the scope: below the pushed one unless it is absolute. Nothing when neither
// exists. Throws LaunchError, at the template or at `where` without one, when the result is no valid namespace.
std::optional<std::string> resolve_namespace(const std::optional<Template>& given, Scope& scope,
                                             const SourceRange& where);

// Makes this the namespace of the scope.
void push_namespace(const Template& given, Scope& scope);

// The namespace of the scope, with which push_namespace() can be undone; nothing when none was pushed.
std::optional<std::string> pushed_namespace(const Scope& scope);
void restore_namespace(const std::optional<std::string>& pushed, Scope& scope);

// The full name of a node, a topic or a service in the scope: a relative one is below its namespace. Throws LaunchError
// at the template when the result is no valid name.
std::string resolve_name(const Template& given, Scope& scope);
// Of a text that was a part of what stands at `where`.
std::string resolve_name(const std::string& text, const Scope& scope, const SourceRange& where);

// "/left" and "talker" are "/left/talker".
std::string qualified_name(const std::string& name_space, const std::string& name);

// Throws LaunchError at `where` unless the life cycle of a managed node has a transition of this name.
void require_transition(const std::string& name, const SourceRange& where);

}  // namespace launch
