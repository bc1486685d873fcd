// SPDX-License-Identifier: Apache-2.0
// Whether the launch arguments of the command line mean anything to the launch file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/language/introspection.hpp"

namespace launch {

// One diagnostic for each name that is given twice, and for each that is unknown, with a suggestion: that neither the
// file and those that it includes nor the launcher itself declares or reads. When an include could not be followed, no
// name can be called unknown.
std::vector<Diagnostic> check_arguments(const std::vector<std::pair<std::string, std::string>>& arguments,
                                        const LaunchDescription& description, const ArgumentList& declared,
                                        Severity severity);

// Whether the text of a launch file reads a configuration. It may do so without declaring it.
bool is_read_in(const LaunchDescription& description, const std::string& name);

}  // namespace launch
