// SPDX-License-Identifier: Apache-2.0
// Parameter values from command line and parameter files, and the selection for a node.
//
// Values are kept per node pattern (`/**`, `/ns/*`, `/ns/node`, or a bare node name from `-p node:name:=value`), in
// order of first appearance over all `-p` and `--params-file`. A repeated pattern and name replaces the value in its
// old position.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rcl/arguments.h"
#include "rcl_yaml_param_parser/read_yaml.hpp"

namespace rcl {

using ParameterValue = rcl_yaml::ParameterValue;

// An empty list. It is an error only for a node that it applies to.
struct NoValue {
  std::string error;
};

// Whether a node pattern matches the node with this fully qualified name.
bool node_pattern_matches(std::string_view pattern, std::string_view fully_qualified_name);

class ParameterOverrides {
 public:
  using Value = std::variant<ParameterValue, NoValue>;
  using Values = std::vector<std::pair<std::string, Value>>;

  void set(std::string_view node_pattern, std::string_view name, Value value);

  // Reads a parameter file; its values replace present ones. Throws std::invalid_argument with `FILE:LINE: what is
  // wrong`.
  void load_file(const std::string& path);

  // The same for the text of a file. `path` is only for errors.
  void load_text(std::string text, const std::string& path);

  // Sets the value of `-p name:=text`, typed as a YAML document. Throws std::invalid_argument.
  void set_from_text(std::string_view node_pattern, std::string_view name, std::string_view text);

  // Adds all values of `other`, which replace present ones.
  void merge(const ParameterOverrides& other);

  // The values for a node by its fully qualified name: those of all matching patterns in order; later ones replace
  // earlier ones. Throws std::invalid_argument if one of them is an empty list.
  std::map<std::string, ParameterValue> for_node(std::string_view fully_qualified_name) const;

  bool empty() const { return patterns_.empty(); }

  // Each pattern, with a leading slash, and its values.
  const std::vector<std::pair<std::string, Values>>& patterns() const { return patterns_; }

 private:
  std::vector<std::pair<std::string, Values>> patterns_;
};

// The overrides of parsed arguments; empty if the arguments have none or were never parsed.
const ParameterOverrides& parameter_overrides(const rcl_arguments_t& arguments);

}  // namespace rcl
