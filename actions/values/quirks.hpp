// SPDX-License-Identifier: Apache-2.0
// Findings about what ROS 2 does, and this launcher with it, though hardly anybody expects it. They are found in a
// visit that explores (launcher/visit/exploration.hpp); otherwise these functions do nothing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/substitution/substitution.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// Words of a command line with a variable whose value has blanks, though it looks like several words. The line is split
// before variables are replaced.
void find_variables_with_blanks(const std::vector<Template>& words, LaunchContext& context);

// The first backslash of a file that goes when the substitutions in its text are performed.
void find_lost_backslash(const std::shared_ptr<const SourceFile>& file, LaunchContext& context);

// A text that is split at a separator which it does not hold, before its variables are replaced.
void find_useless_separator(const std::string& text, const std::string& separator, const SourceRange& where,
                            LaunchContext& context);

// What an included file leaves behind in the scope.
void find_leak(const Scope& before, const SourceRange& include, LaunchContext& context);

}  // namespace launch
