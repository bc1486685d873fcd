// What of a launch file `ros2 launch` would not know (docs/extensions.md).
#pragma once

#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/core/launch_description.hpp"

namespace launch {

// An error for each action, item and attribute that is an extension. Of the file alone, not of those it includes.
std::vector<Diagnostic> beyond_ros2(const LaunchDescription& description, const Registry& registry);

}  // namespace launch
