// SPDX-License-Identifier: Apache-2.0
// `launch schema`: prints a schema of the launch language, for editors.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/registry.hpp"

namespace launch {

// Takes the words after the name of the command. Returns the exit code: 0, or 2 after a wrong command line.
int schema_command(const std::vector<std::string>& words, const Registry& registry);

}  // namespace launch
