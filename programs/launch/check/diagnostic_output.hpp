// SPDX-License-Identifier: Apache-2.0
// Diagnostics for programs: JSON of our own, SARIF 2.1.0, which editors and code hosts show, and annotations of code
// hosts.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

// An array of objects: id, severity, message, help, file, line, column, end_line, end_column (null without a place;
// lines and columns from 1, columns in characters, the end exclusive), included_from (an array of "file:line:column").
std::string diagnostics_as_json(const std::vector<Diagnostic>& diagnostics);

// For a person: render() with the ids. Of each kind the first hundred are shown, and the number of the others.
std::string diagnostics_as_text(const std::vector<Diagnostic>& diagnostics, bool colour);

// One run of the tool `launch check`, with a rule for each kind that was found.
std::string diagnostics_as_sarif(const std::vector<Diagnostic>& diagnostics);

// Annotations of GitHub Actions (workflow commands), and a report for GitLab's Code Quality. Files are named from the
// working directory.
std::string diagnostics_for_github(const std::vector<Diagnostic>& diagnostics);  // diagnostic_annotations.cpp
std::string diagnostics_for_gitlab(const std::vector<Diagnostic>& diagnostics);  // diagnostic_annotations.cpp

}  // namespace launch
