// SPDX-License-Identifier: Apache-2.0
// The transitions of a managed node's life cycle, by the names that ROS 2 gives them.
#pragma once

#include <string>

#include "base/diagnostics/source.hpp"

namespace launch {

// Throws LaunchError at `where` unless there is such a transition.
void require_transition(const std::string& name, const SourceRange& where);

}  // namespace launch
