// SPDX-License-Identifier: Apache-2.0
// What a parameter file holds, as a node reads it. Components get the same types and values from it, though they may
// use more of YAML: aliases, merge keys, and a file that has parameters alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/substitution/parameter.hpp"

namespace launch {

struct FileParameter {
  std::string name;  // nested names are joined by "."
  ParameterValue value;
  SourceRange name_where;
  SourceRange where;
  // ROS 2 reads files for components with another parser than those for nodes: what is different there.
  std::optional<Diagnostic> ros2_component = {};

  bool is_empty_list() const;
};

// The mapping `ros__parameters` below the name of a node, or below a pattern that has * and ** for parts of names.
struct ParameterSection {
  std::string pattern;  // as in the file; the names of nested mappings are joined by "/"
  SourceRange where;
  std::vector<FileParameter> parameters;  // a name that is given twice stands here twice, and the last one counts
  std::vector<Diagnostic> errors;         // of its parameters
  std::vector<Diagnostic> node_errors;    // of parameters that only a component takes
};

struct ParameterSections {
  std::vector<ParameterSection> sections;  // in the order of the file
  // Without any section: the file as the parameters of a component.
  std::optional<ParameterSection> bare;
  std::optional<Diagnostic> no_yaml;       // the text can't be read at all
  std::optional<Diagnostic> node_refuses;  // the first thing outside of parameters that ends a node
};

// Never throws for what is wrong in the text.
ParameterSections read_parameter_sections(const LocatedText& text);

}  // namespace launch
