// SPDX-License-Identifier: Apache-2.0
// The output of `launch --print`: the actions as the launch file has them, with included files in place.
#pragma once

#include <string>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// A tree with a line per element. Includes are followed when their path can be known without visiting.
std::string print_description(const LaunchDescription& description, const Registry& registry, const Scope& scope);

}  // namespace launch
