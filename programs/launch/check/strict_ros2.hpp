// SPDX-License-Identifier: Apache-2.0
// Finds what `ros2 launch` would not know in a launch file (docs/extensions.md).
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// Returns an error for each action, item and attribute that is an extension. It looks at this file alone, not at the
// files that it includes. Throws LaunchError when the file is neither XML nor YAML; a Python file has no errors here.
std::vector<Diagnostic> beyond_ros2(const std::shared_ptr<const SourceFile>& file, const Registry& registry);

}  // namespace launch
