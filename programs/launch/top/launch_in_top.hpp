// SPDX-License-Identifier: Apache-2.0
// `launch --top FILE`: a launch that is seen in `launch top` from its start on.
#pragma once

#include <string>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

// Starts `launch` with these words in the background, and shows it in `launch top`. When the view is left, the lines of
// the launch follow on the terminal. SIGINT and other signals that end this process end the launch instead. Returns the
// exit code of the launch.
int launch_in_top(std::vector<std::string> words, const Environment& environment);

}  // namespace launch
