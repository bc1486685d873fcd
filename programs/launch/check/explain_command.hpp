// SPDX-License-Identifier: Apache-2.0
// `launch explain`: tells what the findings of `launch check` mean.
#pragma once

#include <string>
#include <vector>

namespace launch {

// Takes the words after the name of the command. Returns the exit code: 0, or 2 after a wrong command line.
int explain_command(const std::vector<std::string>& words);

}  // namespace launch
