// SPDX-License-Identifier: Apache-2.0
// Reads the parameters of one node from a parameter file, as a launcher must for nodes that are loaded into a
// container.
#pragma once

#include <string>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/substitution/parameter.hpp"

namespace launch {

// What to do about a file that is not there.
inline const char* help_for_missing_file(const std::string& path) {
  return path.starts_with('/') ? ""
                               : "a relative path is relative to the launcher's working directory; use $(dirname)/…";
}

// Appends what the file holds for the node of this fully qualified name: the sections whose pattern matches it, in the
// order of the file, nested names joined by ".". A file without any `ros__parameters` is a mapping of parameters.
// Throws LaunchError: at `where` when the file can't be read, else at the place in the file.
void append_parameter_file(const std::string& path, const std::string& full_name, const SourceRange& where,
                           std::vector<NamedParameter>& parameters);

// The same for the text of such a file.
void append_parameter_text(const LocatedText& text, const std::string& full_name,
                           std::vector<NamedParameter>& parameters);

}  // namespace launch
