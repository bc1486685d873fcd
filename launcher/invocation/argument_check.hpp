// SPDX-License-Identifier: Apache-2.0
// Checks whether the launch file knows the launch arguments of the command line.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/introspection.hpp"

namespace launch {

// Returns one diagnostic for each name that is given twice, and one with a suggestion for each unknown name. A name is
// unknown when neither the file, nor the files that it includes, nor the launcher itself declares or reads it. When an
// include could not be followed, no name counts as unknown.
std::vector<Diagnostic> check_arguments(const std::vector<std::pair<std::string, std::string>>& arguments,
                                        const LaunchDescription& description, const ArgumentList& declared,
                                        Severity severity);

// Whether the text of a launch file reads a configuration. It may read one that it does not declare.
bool is_read_in(const LaunchDescription& description, const std::string& name);

}  // namespace launch
