// SPDX-License-Identifier: Apache-2.0
// Parameter files as nodes and components get them: their parameters, and what is wrong with them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The help for a file that does not exist.
inline const char* help_for_missing_file(const std::string& path) {
  return path.starts_with('/') ? ""
                               : "a relative path is relative to the launcher's working directory; use $(dirname)/…";
}

// The name of a node as far as the launch file gives it; the program decides the rest.
struct KnownNodeName {
  std::optional<std::string> name;
  std::optional<std::string> name_space;
};

// The name that the remaps in the arguments of a node give it: the first rule counts. Nothing is known of a container,
// because it hosts nodes of other names, and some of them take their parameters from its arguments.
KnownNodeName known_node_name(const std::vector<std::string>& argv);

// Who gets a parameter file.
struct ParameterFileUse {
  std::string path;
  SourceRange where;  // the place that names the file
  KnownNodeName node;
  bool for_many = false;       // it is for every node of a scope, so not each of them needs a section
  std::string performed = {};  // the text of the file with its substitutions performed; empty: as the file has it
};

// Appends the parameters that the file holds for a component, whose name is known, with the types that a node would
// give them. These are the sections whose pattern matches the name, in the order of the file; nested names are joined
// by
// ".". A file without any `ros__parameters` is a mapping of parameters. Throws LaunchError: at `use.where` when the
// file can't be read, else at the place in the file.
void append_parameter_file(const ParameterFileUse& use, LaunchContext& context,
                           std::vector<NamedParameter>& parameters);

// In a visit that explores: what ends a node that reads the file, and what has no effect. In a run: a warning if the
// file has no section for the node.
void find_faults_of_parameter_file(const ParameterFileUse& use, LaunchContext& context);

// The same for the files behind --params-file among the words [first, last) of a command line, which `where` gives.
void find_faults_of_named_files(const std::vector<std::string>& argv, std::size_t first, std::size_t last,
                                const SourceRange& where, LaunchContext& context);

}  // namespace launch
