// SPDX-License-Identifier: Apache-2.0
// The answers to an editor's questions about a place in a launch file. Each takes a position of the protocol and gives
// the result of the request, null for none.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "programs/launch/lsp/argument_places.hpp"
#include "programs/launch/lsp/python_source.hpp"
#include "programs/launch/lsp/python_values.hpp"
#include "programs/launch/lsp/workspace.hpp"

namespace launch::lsp {

// A document with what stands in it: an outline for XML and YAML, calls for Python.
struct Reading {
  const std::string path;
  const Document& document;
  const Outline outline;
  const PythonSource python = {};
};
Reading reading_of(const std::string& path, const Document& document);

bool is_python(const std::string& path);
// A Python file with what its text tells of values.
PythonFileText python_file(const Workspace& workspace, const Reading& reading);

// The argument or configuration that stands at the place.
std::optional<ArgumentPlace> argument_at(const Reading& reading, const Workspace& workspace, std::size_t offset);
std::vector<ArgumentPlace> argument_places(const Reading& reading, const Workspace& workspace);
// The file that an include of the file names, by ArgumentPlace::include; "" if it is not known.
std::string included_file(const Workspace& workspace, const Reading& reading, int include);

Json complete(const Workspace& workspace, const Reading& reading, const Json& position);    // completion.cpp
Json describe(const Workspace& workspace, const Reading& reading, const Json& position);    // hover.cpp
Json inlay_hints(const Workspace& workspace, const Reading& reading, const Json& range);    // inlay_hints.cpp
Json definition(const Workspace& workspace, const Reading& reading, const Json& position);  // navigation.cpp
Json symbols(const Reading& reading);                                                       // navigation.cpp
Json folds(const Reading& reading);                                                         // navigation.cpp

Json semantic_token_legend();                  // semantic_tokens.cpp
Json semantic_tokens(const Reading& reading);  // semantic_tokens.cpp
// `processes`: how many the file starts, if a check has told. The commands are those of the editor (docs/editors.md).
Json code_lenses(const Reading& reading, std::optional<std::size_t> processes);  // code_lenses.cpp

// The launch files below a folder, without hidden ones and without what colcon has made. Python ones only if they are
// wanted.
std::set<std::string> files_below(const std::string& folder, const std::string& own, bool python);  // references.cpp

// Where an argument or a configuration of the file is declared and read. `everywhere`: also in the launch files below
// the folder that include this file and give it the argument. Null when nothing of that kind stands at the position.
Json references(const Workspace& workspace, const Reading& reading, const Json& position,
                const std::string& folder);                                                     // references.cpp
Json prepare_rename(const Workspace& workspace, const Reading& reading, const Json& position);  // references.cpp
Json rename(const Workspace& workspace, const Reading& reading, const Json& position, const std::string& name,
            const std::string& folder);  // references.cpp

// What a check finds: {"diagnostics": those of `launch check`, "processes": how many the file starts}, the second one
// only if the file can be visited. Runs the check in this process.
Json check_document(const Workspace& workspace, const Reading& reading);  // diagnostics.cpp
// What can be done about the diagnostics.
Json code_actions(const Reading& reading, const Json& diagnostics);  // quick_fixes.cpp
// The names that the help of a finding suggests: did you mean 'a' or 'b'?
std::vector<std::string> suggested_names(const std::string& help);  // quick_fixes.cpp

}  // namespace launch::lsp
