// SPDX-License-Identifier: Apache-2.0
// Diagnostics for programs: JSON of our own, and SARIF 2.1.0, which editors and code hosts show.
#pragma once

#include <string>
#include <vector>

#include "launcher/base/diagnostic.hpp"

namespace launch {

// An array of objects: severity, message, help, file, line, column, end_line, end_column (null without a place; lines
// and columns from 1, columns in characters, the end exclusive), included_from (an array of "file:line:column").
std::string diagnostics_as_json(const std::vector<Diagnostic>& diagnostics);

// One run of the tool `launch check`.
std::string diagnostics_as_sarif(const std::vector<Diagnostic>& diagnostics);

}  // namespace launch
