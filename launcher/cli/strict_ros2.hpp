// SPDX-License-Identifier: Apache-2.0
// What of a launch file `ros2 launch` would not know (docs/extensions.md).
#pragma once

#include <memory>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// An error for each action, item and attribute that is an extension. Of the file alone, not of those it includes.
// Throws LaunchError when the file is no XML and no YAML; nothing is said of Python files.
std::vector<Diagnostic> beyond_ros2(const std::shared_ptr<const SourceFile>& file, const Registry& registry);

}  // namespace launch
