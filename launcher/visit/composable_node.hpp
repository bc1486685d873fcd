// SPDX-License-Identifier: Apache-2.0
// The requests of a launch to component containers and to nodes with a managed life cycle.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct ComposableNode {
  std::string package;
  std::string plugin;
  std::string name;
  std::string name_space;                                   // empty: the container's choice
  std::vector<NamedParameter> parameters;                   // in order; the last parameter of a name wins
  std::vector<std::pair<std::string, std::string>> remaps;  // from, to
  std::vector<NamedParameter> extra_arguments;
  bool autostart = false;  // configure and activate it once it is loaded
  SourceRange origin;
};

// The nodes of one action, which are loaded one after another.
struct LoadRequest {
  std::string target;  // node name of the container
  std::vector<ComposableNode> nodes;
  Environment environment;  // chooses the ROS graph, by ROS_DOMAIN_ID and the like
  SourceRange origin;
};

// Transitions of one node, made one after another until one fails.
struct TransitionRequest {
  std::string node;                      // fully qualified name
  std::vector<std::string> transitions;  // configure, activate, deactivate, cleanup, shutdown
  bool autostart = false;                // again whenever the node's process starts again
  Environment environment;
  SourceRange origin;
};

}  // namespace launch
