// What a launch asks component containers to load.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/substitution/parameter.hpp"

namespace launch {

struct ComposableNode {
  std::string package;
  std::string plugin;
  std::string name;
  std::string name_space;                                   // empty: the container's choice
  std::vector<NamedParameter> parameters;                   // in order, the last of a name wins
  std::vector<std::pair<std::string, std::string>> remaps;  // from, to
  std::vector<NamedParameter> extra_arguments;
  SourceRange origin;
};

// The nodes of one action, which are loaded one after another.
struct LoadRequest {
  std::string target;  // node name of the container
  std::vector<ComposableNode> nodes;
  SourceRange origin;
};

}  // namespace launch
