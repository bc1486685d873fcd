// SPDX-License-Identifier: Apache-2.0
// The answers to an editor's questions about a place in a Python launch file (features.hpp). Nothing of the file is
// run.
#pragma once

#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

Json complete_python(const Workspace& workspace, const Reading& reading,
                     const Json& position);  // python_completion.cpp
Json describe_python(const Workspace& workspace, const Reading& reading, const Json& position);  // python_places.cpp
Json definition_in_python(const Workspace& workspace, const Reading& reading,
                          const Json& position);                          // python_places.cpp
Json python_symbols(const Workspace& workspace, const Reading& reading);  // python_places.cpp
Json python_folds(const Reading& reading);                                // python_places.cpp

// What is wrong by the text alone: names that a module of launch does not have, arguments that a class does not take,
// packages that are missing. Diagnostics of the protocol.
Json python_findings(const Workspace& workspace, const Reading& reading);  // python_findings.cpp
// Reads the table of names and starts Python, so that processes which are forked from now on need not do so for each
// check. Nothing of the user's runs.
void prepare_python_findings();  // python_findings.cpp

}  // namespace launch::lsp
