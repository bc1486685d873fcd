// SPDX-License-Identifier: Apache-2.0
// Reads the parameters of one node from a parameter file. The launcher must do so for nodes that are loaded into a
// container.
#pragma once

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

// Appends the parameters that the file holds for the node of this fully qualified name. These are the sections whose
// pattern matches the name, in the order of the file; nested names are joined by ".". A file without any
// `ros__parameters` is a mapping of parameters. Throws LaunchError: at `where` when the file can't be read, else at the
// place in the file.
void append_parameter_file(const std::string& path, const std::string& full_name, const SourceRange& where,
                           std::vector<NamedParameter>& parameters);

// The same for the text of such a file.
void append_parameter_text(const LocatedText& text, const std::string& full_name,
                           std::vector<NamedParameter>& parameters);

// A node ends when its parameter file is no YAML, or when a value stands outside of ros__parameters. The places are in
// the file, which is read once for each visit.
void find_faults_of_parameter_file(const std::string& path, const SourceRange& where, LaunchContext& context);

}  // namespace launch
