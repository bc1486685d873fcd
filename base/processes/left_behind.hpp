// SPDX-License-Identifier: Apache-2.0
// What launch-guardian has had to end after a launch, as its messages say.
#pragma once

#include <string>
#include <vector>

namespace launch {

// Each message, such as "planner-3 left 1 process running: sleep (1234)". `screen` is all that the launch wrote there.
std::vector<std::string> left_behind(const std::string& screen);

}  // namespace launch
